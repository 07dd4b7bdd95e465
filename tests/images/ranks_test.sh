#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ranks_test.sh NORTHLIGHT: a reference shared by ranks of mpirun has the same bits as one process's,
# goes on with any number of ranks, and survives the loss of one, which is named.
set -u
northlight=$1
if ! command -v mpirun > /dev/null; then
  echo "SKIPPED: there is no mpirun (Debian: openmpi-bin, libopenmpi-dev)"
  exit 77
fi
if ! ldd "$northlight" | grep -q 'libmpi'; then
  echo "SKIPPED: northlight was built without MPI (Debian: libopenmpi-dev)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Open MPI wants to be asked before it runs as root, and more ranks than cores.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
scene=(--scene glass-stack --size 48x30 --threads 1)

"$northlight" "${scene[@]}" --reference-path-traced 96 --out "$work/alone" > /dev/null || fail "one process"
for ranks in 2 3; do
  mpirun -n $ranks "$northlight" "${scene[@]}" --reference-path-traced 96 --out "$work/shared" > "$work/log" 2>&1 \
    || fail "$ranks ranks: $(cat "$work/log")"
  grep -q "$ranks ranks" "$work/log" || fail "$ranks ranks: the ranks do not share: $(cat "$work/log")"
  cmp -s "$work/alone/reference.sums" "$work/shared/reference.sums" || fail "$ranks ranks give other bits"
done

# What two ranks began, three go on with.
mpirun -n 2 "$northlight" "${scene[@]}" --reference-path-traced 32 --out "$work/begun" > /dev/null 2>&1 || fail "2 ranks"
mpirun -n 3 "$northlight" "${scene[@]}" --reference-path-traced 96 --resume --out "$work/begun" > "$work/log" 2>&1 \
  || fail "--resume with 3 ranks: $(cat "$work/log")"
cmp -s "$work/alone/reference.sums" "$work/begun/reference.sums" || fail "--resume with 3 ranks gives other bits"
mpirun -n 2 "$northlight" "${scene[@]}" --reference-path-traced 96 --resume --seed 5 --out "$work/begun" > "$work/log" 2>&1 \
  && fail "ranks go on with another seed's sums"
grep -q 'KA3048 .*its seed is 0, not 5' "$work/log" || fail "another seed's sums: $(cat "$work/log")"

# Rank 1 dies. What was saved is whole, and can be gone on with.
mpirun -n 2 bash -c 'if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then echo $$ > "$0/pid"; fi; exec "$@"' "$work" \
  "$northlight" "${scene[@]}" --reference-path-traced 1000000 --save-seconds 0 --out "$work/lost" > "$work/log" 2>&1 &
run=$!
for _ in $(seq 600); do
  [ -s "$work/lost/reference.sums" ] && break
  sleep 0.1
done
[ -s "$work/lost/reference.sums" ] || fail "nothing was saved: $(cat "$work/log")"
kill -9 "$(cat "$work/pid")"
wait "$run" && fail "a lost rank went unnoticed"
grep -qi 'rank 1' "$work/log" || fail "the lost rank is not named: $(cat "$work/log")"
"$northlight" "${scene[@]}" --reference-path-traced 2 --resume --out "$work/lost" > "$work/log" 2>&1 \
  || fail "what was saved cannot be gone on with: $(cat "$work/log")"

[ "$failures" = 0 ] && echo "ranks share a reference as expected"
exit "$((failures > 0))"
