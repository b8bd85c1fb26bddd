#!/usr/bin/env bash
# same_bits.sh PROGRAM_A PROGRAM_B: both pack every scene of scenes.tsv on this machine, in turn; hash, series, report,
# tables and text exports of the two must agree byte for byte. For a change that must not move bits: A is the build
# before it.
set -euo pipefail
a=$(realpath "$1") b=$(realpath "$2")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0

outputs() {  # PROGRAM DIRECTORY ARGUMENTS...: everything that a user can get out of this scene
  local program=$1 out=$2 code=0
  shift 2
  mkdir -p "$out"
  "$program" pack "${@/SERIES/$out/energies.csv}" -o "$out/state.h5" --set "output.series=\"$out/series.csv\"" 2> "$out/pack.txt" || code=$?
  echo "exit $code" >> "$out/pack.txt"
  for state in "$out"/*.h5; do "$program" info "$state" | grep '"hash"' >> "$out/hash.txt"; done
  "$program" analyze "$out/state.h5" --json "$out/report.json" --csv "$out/tables" > "$out/report.txt" 2>&1
  "$program" analyze "$out/state.h5" --only rigidity,clusters,stiffness,moduli,modes,bases --cell free --json "$out/free.json" > /dev/null 2>&1
  for format in net csv dump vtp xyz; do "$program" convert "$out/state.h5" -o "$out/text.$format" > /dev/null; done
  for what in grains forces clusters; do "$program" draw "$out/state.h5" -o "$out/$what.svg" --what $what > /dev/null; done
  rm "$out"/*.h5
  sed -i "s|$out|OUT|g" "$out"/*.txt "$out"/*.json
  sed -i '/^OUT\/state.h5: Phi /d' "$out/pack.txt"  # how long it took
}

while IFS=$'\t' read -r name where arguments; do
  [[ $name != \#* ]] || continue
  read -ra words <<< "$arguments"
  outputs "$a" "$work/a" "${words[@]}" & first=$!
  outputs "$b" "$work/b" "${words[@]}"
  wait $first
  if diff -rq "$work/a" "$work/b"; then echo "$name: the same"; else echo "$name: DIFFERS"; bad=1; fi
  [[ -z ${KEEP:-} ]] || cp -r "$work" "$KEEP/$name"
  rm -rf "$work/a" "$work/b"
done < tests/golden/scenes.tsv
exit $bad
