// SPDX-License-Identifier: MIT
#include "effects/measure/truth/ranks.h"

#ifdef KAAMOS_HAS_MPI
#define OMPI_SKIP_MPICXX 1  // only the C interface
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#endif

namespace kaamos::measure {

#ifdef KAAMOS_HAS_MPI

namespace {

// Values of one message: its count is an int.
constexpr std::size_t kMostValues = std::size_t{1} << 24;

bool is_started_by_mpi() {
  // Open MPI, MPICH and Intel MPI, Slurm.
  for (const char* name :
       {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_STEP_NUM_TASKS"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

template <class T, class Send>
void in_messages(std::span<T> values, Send send) {
  for (std::size_t at = 0; at < values.size(); at += kMostValues) {
    const auto part = values.subspan(at, std::min(kMostValues, values.size() - at));
    send(part.data(), static_cast<int>(part.size()));
  }
}

}  // namespace

Ranks::Ranks() {
  if (!is_started_by_mpi()) return;
  MPI_Init(nullptr, nullptr);
  has_begun_ = true;
  int rank = 0, count = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  rank_ = static_cast<std::uint32_t>(rank);
  count_ = static_cast<std::uint32_t>(count);
}

Ranks::~Ranks() {
  if (has_begun_) MPI_Finalize();
}

void Ranks::sum_at_first(std::span<double> values) const {
  if (count_ == 1) return;
  in_messages(values, [&](double* at, int count) {
    if (is_first()) {
      MPI_Reduce(MPI_IN_PLACE, at, count, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    } else {
      MPI_Reduce(at, nullptr, count, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    }
  });
}

void Ranks::copy_from_first(std::span<double> values) const {
  if (count_ == 1) return;
  in_messages(values,
              [](double* at, int count) { MPI_Bcast(at, count, MPI_DOUBLE, 0, MPI_COMM_WORLD); });
}

void Ranks::copy_from_first(std::span<std::uint32_t> values) const {
  if (count_ == 1) return;
  in_messages(values, [](std::uint32_t* at, int count) {
    MPI_Bcast(at, count, MPI_UINT32_T, 0, MPI_COMM_WORLD);
  });
}

bool Ranks::any(bool value) const {
  if (count_ == 1) return value;
  int here = value ? 1 : 0, anywhere = 0;
  MPI_Allreduce(&here, &anywhere, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD);
  return anywhere != 0;
}

#else

Ranks::Ranks() = default;
Ranks::~Ranks() = default;
void Ranks::sum_at_first(std::span<double>) const {}
void Ranks::copy_from_first(std::span<double>) const {}
void Ranks::copy_from_first(std::span<std::uint32_t>) const {}
bool Ranks::any(bool value) const {
  return value;
}

#endif

}  // namespace kaamos::measure
