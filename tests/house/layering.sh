#!/usr/bin/env bash
# layering.sh ROOT: which room and which folder may include which. Prints every offence as FILE: what it reaches, and
# exits 1 if there is one. The layers are data: a file sees its own layer and those of lower rank.
#   rooms     geometry < dem < analysis < apps (CMakeLists.txt lists them in this order)
#   dem       headers of scene < state < solver < run, files and sample; the folder of a system stands on all of them,
#             and of a system know only scene.hpp (its part of the scene), systems.hpp and the sources of files
#   AnyState  a state of an unknown system stands where files and commands meet one, nowhere else
#   analysis  sees states and the interface of finishing, never what marches a state in time, not even by a chain
#   headers   no header shows a type of CGAL, SuiteSparse, GSL, HDF5, Cairo, FFTW or toml++
set -euo pipefail
cd "$1"
mapfile -t files < <(find geometry dem analysis apps -name '*.hpp' -o -name '*.cpp' | sort)
((${#files[@]})) || { echo "no source file under $1" >&2; exit 1; }

awk '
function folder(file,    part, n) {  # dem/state/link.hpp: dem/state; analysis/network/x.hpp: analysis
  n = split(file, part, "/")
  return part[1] == "dem" && n > 2 ? part[1] "/" part[2] : part[1]
}
function reaches(file, origin, chain,    n, list, k) {  # depth first through the includes of the project
  if (seen[origin, file]++) return
  if (file != origin && file ~ marching) { print origin ": reaches the solver by" chain; bad = 1; return }
  n = split(includes[file], list, " ")
  for (k = 1; k <= n; ++k) reaches(list[k], origin, chain " " list[k])
}
BEGIN {
  room["geometry"] = 1; room["dem"] = 2; room["analysis"] = 3; room["apps"] = 4
  layer["dem/scene"] = 1; layer["dem/state"] = 2; layer["dem/solver"] = 3; layer["dem/run"] = 4; layer["dem/files"] = 4
  layer["dem/sample"] = 4
  marching = "^dem/(solver/(solver|neighbours|team|barostat)|run/(stage|stages|observers)[a-z_]*\\.|disks/(kernel/|engine|bodies_store|motion|pairs)|triangles/(kernel/|engine|store|motion)|spheres/(kernel/|engine|sphere_store|motion|pairs|walls))"
  system_folder = "^dem/(disks|triangles|spheres)/"
  shared_folder = "^dem/(scene|state|solver|run|files|sample)/"
  foreign = "^(CGAL|boost)/|^(suitesparse/)?(cholmod|umfpack|SuiteSparse|amd|metis)[^/]*\\.h|^gsl/|^(hdf5|H5)|^cairo|^fftw3|^toml"
}
FNR == 1 { all[FILENAME] }
/^[ \t]*#[ \t]*include[ \t]*[<"]/ {
  match($0, /[<"][^>"]+[>"]/)
  target = substr($0, RSTART + 1, RLENGTH - 2)
  header = FILENAME ~ /\.hpp$/
  if (header && target ~ foreign) { print FILENAME ": shows " target " in a header"; bad = 1 }
  from = folder(FILENAME); to = folder(target)
  to_room = substr(target, 1, index(target, "/") - 1)
  if (!(to_room in room)) next
  if (room[to_room] > room[substr(FILENAME, 1, index(FILENAME, "/") - 1)]) {
    print FILENAME ": includes " target " of a later room"; bad = 1
  }
  if (header && from in layer && to in layer && layer[to] > layer[from]) {
    print FILENAME ": includes " target " of a later layer"; bad = 1
  }
  if (FILENAME ~ shared_folder && target ~ system_folder && FILENAME !~ /^dem\/files\/.*\.cpp$/ &&
      !(FILENAME == "dem/scene/scene.hpp" && target ~ /\/scene\.hpp$/)) {
    print FILENAME ": includes " target " of a system"; bad = 1
  }
  includes[FILENAME] = includes[FILENAME] " " target
}
END {
  for (file in all) if (file ~ /^analysis\//) reaches(file, file, "")
  exit bad
}' "${files[@]}"

any_state=$(grep -lw AnyState "${files[@]}" | grep -vE '^(dem/systems\.|dem/files/state_file\.|apps/)' || true)
[[ -z $any_state ]] || { sed 's/$/: names AnyState/' <<< "$any_state"; exit 1; }
