#!/usr/bin/env bash
# Short runs of a program built with sanitizers: fracture, bars, contact and a rigid hammer; a demo beam; going on from a
# checkpoint. Any report ends the program with an error, and so this script.
#     tools/sanitized_runs.sh PROGRAM THREADS
set -euo pipefail
program=$(realpath "$1") threads=$2
root=$(cd "$(dirname "$0")/.." && pwd)
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT
beam=$root/tests/regression/decks/smashed_beam.toml

"$program" run "$beam" --out "$runs/beam" --threads "$threads" --until 0.002 --set output.checkpoint_steps=500 --quiet
"$program" run "$beam" --restart "$runs/beam" --threads "$threads" --until 0.003 --quiet
"$program" run "$root/examples/00_demo_beam/case.toml" --out "$runs/demo" --threads "$threads" --set run.max_steps=300 --quiet
"$program" check "$root/examples/10_column_ground_motion/case.toml" >/dev/null
echo "sanitized runs: no report with $threads threads"
