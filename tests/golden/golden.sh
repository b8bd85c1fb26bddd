#!/usr/bin/env bash
# golden.sh PROGRAM [NAME]: packs the scenes of scenes.tsv marked `everywhere` with every instruction set that the machine
# has and compares the physical hashes of the ends with hashes.tsv. With GOLDEN_WRITE=1 it prints the table anew: move
# a hash only with the reason in the commit.
set -euo pipefail
program=$(realpath "$1")
only=${2:-}
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0
skipped=()

hash_of() {  # INSTRUCTION_SET ARGUMENTS...: of the state that this run ends in
  local isa=$1 code=0
  shift
  rm -f "$work/state.h5"
  ISOSTAT_ISA=$isa "$program" pack "${@/SERIES/$work/series.csv}" -o "$work/state.h5" 2> "$work/said" || code=$?
  ((code == 0 || code == 3)) || { cat "$work/said" >&2; return 1; }
  "$program" info "$work/state.h5" | sed -n 's/.*"hash": "\([0-9a-f]*\)".*/\1/p'
}

for isa in scalar avx2 avx512; do
  if ! ISOSTAT_ISA=$isa "$program" lab throughput data/clusters/periodic_triangular4.net --steps 1 > "$work/said" 2>&1; then
    skipped+=("$isa")
    continue
  fi
  while IFS=$'\t' read -r name where arguments; do
    [[ $name != \#* && $where == everywhere && (-z $only || $only == "$name") ]] || continue
    read -ra words <<< "$arguments"
    got=$(hash_of $isa "${words[@]}")
    if [[ ${GOLDEN_WRITE:-0} == 1 ]]; then printf '%s\t%s\t%s\n' "$name" $isa "$got"; continue; fi
    want=$(awk -F'\t' -v name="$name" -v isa=$isa '$1 == name && $2 == isa {print $3}' tests/golden/hashes.tsv)
    [[ $got == "$want" ]] || { echo "$name, $isa: $got, pinned is ${want:-nothing}"; bad=1; }
  done < tests/golden/scenes.tsv
done
((${#skipped[@]} == 0)) || echo "not run: ${skipped[*]} (not on this machine, or not in this build)" >&2
exit $bad
