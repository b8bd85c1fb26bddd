#!/usr/bin/env bash
# layering.sh ROOT: which room may include which (CMakeLists.txt lists them in the order of their dependencies).
# Prints every offence as FILE: what it reaches, and exits 1 if there is one.
#   geometry sees itself; dem sees geometry; analysis sees both but never what marches a state in time; no header shows
#   a type of CGAL, SuiteSparse, GSL, HDF5, Cairo, FFTW or toml++.
set -euo pipefail
cd "$1"
mapfile -t files < <(find geometry dem analysis apps -name '*.hpp' -o -name '*.cpp' | sort)
((${#files[@]})) || { echo "no source file under $1" >&2; exit 1; }

awk '
function rank(file) { return order[substr(file, 1, index(file, "/") - 1)] }
function reaches(file, origin, chain,    n, list, k) {  # depth first through the includes of the project
  if (seen[origin, file]++) return
  if (file != origin && file ~ marching) { print origin ": reaches the solver by" chain; bad = 1; return }
  n = split(includes[file], list, " ")
  for (k = 1; k <= n; ++k) reaches(list[k], origin, chain " " list[k])
}
BEGIN {
  order["geometry"] = 1; order["dem"] = 2; order["analysis"] = 3; order["apps"] = 4
  marching = "^dem/(kernel/|solver|stepper|neighbours|bodies_store|team|protocol|barostat)"
  foreign = "^(CGAL|boost)/|^(suitesparse/)?(cholmod|umfpack|SuiteSparse|amd|metis)[^/]*\\.h|^gsl/|^(hdf5|H5)|^cairo|^fftw3|^toml"
}
FNR == 1 { all[FILENAME] }
/^[ \t]*#[ \t]*include[ \t]*[<"]/ {
  match($0, /[<"][^>"]+[>"]/)
  target = substr($0, RSTART + 1, RLENGTH - 2)
  if (FILENAME ~ /\.hpp$/ && target ~ foreign) { print FILENAME ": shows " target " in a header"; bad = 1 }
  room = substr(target, 1, index(target, "/") - 1)
  if (!(room in order)) next
  if (order[room] > rank(FILENAME)) { print FILENAME ": includes " target " of a later room"; bad = 1 }
  includes[FILENAME] = includes[FILENAME] " " target
}
END {
  for (file in all) if (file ~ /^analysis\//) reaches(file, file, "")
  exit bad
}' "${files[@]}"
