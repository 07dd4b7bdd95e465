# SPDX-License-Identifier: MIT
"""Checks .github/workflows/ci.yml: only hosted CI runs it, and would show a mistake in it after the push.

workflow_test.py ROOT         the workflow of the project at ROOT: exit status 1 and one line for each fault
workflow_test.py ROOT --self  whether the check finds each of FAULTS when it is put into that workflow
Exit status 77 without PyYAML (Debian: python3-yaml), which ctest counts as skipped.
"""

import itertools
import os
import re
import subprocess
import sys

try:
    import yaml
except ImportError:
    print("PyYAML is not installed (Debian: python3-yaml)")
    sys.exit(77)

WORKFLOW = ".github/workflows/ci.yml"
RELEASE_MATRIX = set(itertools.product(("12", "13"), ("gcc", "clang")))
CONTEXTS = {"github", "matrix", "env", "runner", "job", "steps", "needs", "secrets", "inputs"}


class Loader(yaml.SafeLoader):
    """Refuses a key that is given twice, as GitHub does; PyYAML by itself takes the last one."""

    def construct_mapping(self, node, deep=False):
        keys = [self.construct_object(key, deep=deep) for key, _ in node.value]
        for key in keys:
            if keys.count(key) > 1:
                raise yaml.constructor.ConstructorError(
                    None, None, f'the key "{key}" stands there twice', node.start_mark)
        return super().construct_mapping(node, deep)


def options_of_scripts_test(root):
    help_text = subprocess.run(
        [os.path.join(root, "scripts/test"), "--help"], capture_output=True, text=True, check=True).stdout
    parts = set(re.findall(r"^ {23}(\w+)  ", help_text, re.MULTILINE))
    return set(re.findall(r"--[a-z-]+", help_text)), parts


def matrix_of(job):
    matrix = job.get("strategy", {}).get("matrix", {})
    return matrix if isinstance(matrix, dict) else {}


def check_expressions(text, matrix):
    """Faults of each ${{ ... }} in a text."""
    if text.count("${{") != len(re.findall(r"\$\{\{.*?\}\}", text)):
        yield f'"${{{{" without its end in "{text}"'
    for expression in re.findall(r"\$\{\{(.*?)\}\}", text):
        outside_quotes = re.sub(r"'[^']*'", "", expression)
        for context, name in re.findall(r"\b([a-z]+)\.([A-Za-z_]+)", outside_quotes):
            if context not in CONTEXTS:
                yield f'there is no context "{context}" in "{expression.strip()}"'
            elif context == "matrix" and name not in matrix:
                yield f'the matrix has no "{name}"'


def strings_in(node):
    if isinstance(node, dict):
        node = list(node.keys()) + list(node.values())
    if isinstance(node, list):
        for each in node:
            yield from strings_in(each)
    elif isinstance(node, str):
        yield node


def check_run(root, command, matrix):
    """Faults of a step's shell command."""
    shell = subprocess.run(["bash", "-n"], input=re.sub(r"\$\{\{.*?\}\}", "x", command),
                           capture_output=True, text=True, check=False)
    if shell.returncode:
        yield f'bash does not take "{command.strip()}": {shell.stderr.strip()}'
    options, parts = options_of_scripts_test(root)
    for line in command.splitlines():
        if ".ci/run" not in line:
            continue
        words = re.sub(r"\$\{\{ *matrix\.(\w+) *\}\}",
                       lambda found: ",".join(map(str, matrix.get(found[1], []))), line).split()
        for word in words[words.index(".ci/run") + 1:]:
            option, _, value = word.partition("=")
            if option not in options:
                yield f'scripts/test has no option "{option}"'
            for part in filter(None, value.split(",")):
                if option == "--full" and part not in parts:
                    yield f'scripts/test --full has no part "{part}"'


def check_step(root, step, matrix):
    if not isinstance(step, dict) or ("run" in step) == ("uses" in step):
        yield f'a step has either "run" or "uses": {step}'
    elif "uses" in step and not re.fullmatch(r"[\w.-]+/[\w./-]+@[\w.-]+", step["uses"]):
        yield f'"{step["uses"]}" is not OWNER/ACTION@VERSION'
    elif "run" in step:
        yield from check_run(root, step["run"], matrix)


def check_job(root, job):
    if not isinstance(job, dict) or not isinstance(job.get("steps"), list) or "runs-on" not in job:
        yield 'has no "runs-on" or no list of "steps"'
        return
    matrix = matrix_of(job)
    for text in strings_in(job):
        yield from check_expressions(text, matrix)
    for step in job["steps"]:
        yield from check_step(root, step, matrix)
    steps = [step for step in job["steps"] if isinstance(step, dict)]
    if not any(re.search(r"(^|\s)\.ci/run\b", step.get("run", "")) for step in steps):
        yield "does not run .ci/run"
    if not str(steps[0].get("uses", "")).startswith("actions/checkout@"):
        yield "does not begin with actions/checkout"


def check_coverage(jobs):
    """Which systems, compilers and sanitizers there must be, and when."""
    pairs, parts = set(), set()
    for job in jobs.values():
        condition, matrix = str(job.get("if", "")), matrix_of(job)
        if "github.event_name != 'schedule'" in condition:
            pairs |= set(itertools.product(matrix.get("debian", []), matrix.get("compiler", [])))
        if "github.event_name == 'schedule'" in condition:
            parts |= set(matrix.get("part", []))
    if pairs != RELEASE_MATRIX:
        yield f"pushes are tested on {sorted(pairs, key=str)}, not on {sorted(RELEASE_MATRIX)}"
    for part in {"asan", "tsan", "files", "packages"} - parts:
        yield f"{part} does not run on schedule"


def check(root, text):
    """Every fault of a workflow, in words."""
    try:
        workflow = yaml.load(text, Loader)
    except yaml.YAMLError as error:
        return [f"is not YAML: {error}"]
    if not isinstance(workflow, dict):
        return ["is not a mapping"]
    faults = []
    triggers = workflow.get(True, workflow.get("on"))  # YAML 1.1 reads "on" as true
    if not isinstance(triggers, dict) or not {"push", "pull_request", "schedule"} <= set(triggers):
        faults.append("does not run on push, pull_request and schedule")
    elif not all(re.fullmatch(r"(\S+ ){4}\S+", str(each.get("cron"))) for each in triggers["schedule"]):
        faults.append("has a schedule that is not five fields of cron")
    jobs = workflow.get("jobs")
    if not isinstance(jobs, dict) or not jobs:
        return faults + ["has no jobs"]
    for name, job in jobs.items():
        faults += [f"job {name}: {fault}" for fault in check_job(root, job)]
    if not faults:
        faults += check_coverage(jobs)
    if not os.access(os.path.join(root, ".ci/run"), os.X_OK):
        faults.append("runs .ci/run, which is not an executable file")
    return faults


# What is replaced in the workflow, by what, and a part of what the check has to say of it.
FAULTS = [
    ("jobs:", "jobs", "is not YAML"),
    ("permissions:\n", "permissions: {}\npermissions:\n", "twice"),
    ("  schedule:\n", "  schedule_:\n", "does not run on push, pull_request and schedule"),
    ('cron: "17 2 * * *"', 'cron: "17 2 * *"', "five fields"),
    ("jobs:", "job_list:", "has no jobs"),
    ("runs-on: ubuntu-latest", "runs_on: ubuntu-latest", "runs-on"),
    ('debian: ["12", "13"]', 'debian: ["12"]', "pushes are tested on"),
    ("compiler: [gcc, clang]", "compiler: [gcc]", "pushes are tested on"),
    ("        compiler: [", "        compilers: [", 'the matrix has no "compiler"'),
    ("part: [asan, tsan, files, packages]", "part: [asan, files, packages]", "tsan does not run on schedule"),
    ("part: [asan, tsan, files, packages]", "part: [asan, tsan, files, packages, msan]", 'has no part "msan"'),
    (".ci/run --full", ".ci/run --everything", 'no option "--everything"'),
    (".ci/run --full=", "scripts/test --full=", "does not run .ci/run"),
    ("${{ matrix.part }}", "${{ matrix.part }", 'without its end'),
    ("${{ matrix.part }}", "${{ matrices.part }}", 'no context "matrices"'),
    ("uses: actions/checkout@v4", "uses: actions/checkout", "OWNER/ACTION@VERSION"),
    ("run: echo 28", "runs: echo 28", 'either "run" or "uses"'),
    ("apt-get update &&", "apt-get update && (", "bash does not take"),
]


def check_itself(root, text):
    faults = []
    for old, new, wanted in FAULTS:
        if old not in text:
            faults.append(f'the workflow has no "{old}" to put a fault in its place')
            continue
        found = check(root, text.replace(old, new, 1))
        if not any(wanted in fault for fault in found):
            faults.append(f'"{new}" instead of "{old}" gives {found}, nothing with "{wanted}"')
    return faults


def main():
    root = sys.argv[1]
    with open(os.path.join(root, WORKFLOW), encoding="utf-8") as file:
        text = file.read()
    faults = check_itself(root, text) if sys.argv[2:] == ["--self"] else check(root, text)
    for fault in faults:
        print(f"{WORKFLOW}: {fault}")
    print(f"{len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
