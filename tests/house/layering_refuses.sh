#!/usr/bin/env bash
# layering_refuses.sh DIRECTORY_OF_layering.sh: the layering check accepts a clean tree and names each kind of offence.
set -euo pipefail
check="$1/layering.sh"
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT

clean_tree() {
  rm -rf "${root:?}"/*
  mkdir -p "$root"/{geometry,dem/scene,dem/state,dem/solver,dem/files,dem/{disks,triangles}/kernel,analysis,apps}
  echo '#include <vector>' > "$root/geometry/cell.hpp"
  echo '#include "geometry/cell.hpp"' > "$root/dem/state/state.hpp"
  echo '#include "dem/state/state.hpp"' > "$root/dem/disks/kernel/march.hpp"
  echo '#include "dem/state/state.hpp"' > "$root/dem/triangles/kernel/march.hpp"
  echo '#include "dem/state/state.hpp"' > "$root/dem/triangles/engine.hpp"
  echo '#include "dem/state/state.hpp"' > "$root/dem/solver/march.hpp"
  echo '#include <vector>' > "$root/dem/scene/scene.hpp"
  printf '#include <hdf5.h>\n#include "dem/state/state.hpp"\n' > "$root/dem/files/state_file.cpp"
  echo '#include "dem/state/state.hpp"' > "$root/analysis/counts.hpp"
  printf '#include "analysis/counts.hpp"\n#include "dem/disks/kernel/march.hpp"\n' > "$root/apps/main.cpp"
}
refuses() {  # FILE INCLUDE: adding that line to a clean tree must be refused, with the file named
  clean_tree
  echo "#include $2" >> "$root/$1"
  if said=$(bash "$check" "$root"); then echo "accepted $2 in $1"; exit 1; fi
  grep -q "^$1:" <<< "$said" || { echo "refused $2 in $1 without naming it: $said"; exit 1; }
}

clean_tree
bash "$check" "$root" || { echo "refused a clean tree"; exit 1; }
refuses geometry/cell.hpp '"dem/state/state.hpp"'
refuses geometry/cell.hpp '"analysis/counts.hpp"'
refuses dem/state/state.hpp '"analysis/counts.hpp"'
refuses dem/state/state.hpp '"dem/solver/march.hpp"'
refuses dem/scene/scene.hpp '"dem/state/state.hpp"'
refuses dem/state/state.hpp '"dem/disks/disks.hpp"'
refuses dem/solver/march.hpp '"dem/disks/kernel/march.hpp"'
refuses dem/state/state.hpp '"dem/triangles/engine.hpp"'
refuses dem/files/state_file.cpp '"apps/commands.hpp"'
refuses analysis/counts.hpp '"apps/commands.hpp"'
refuses analysis/counts.hpp '"dem/disks/kernel/march.hpp"'
refuses analysis/counts.hpp '"dem/triangles/kernel/march.hpp"'
refuses analysis/counts.hpp '"dem/triangles/engine.hpp"'
for header in CGAL/Cartesian.h cholmod.h suitesparse/umfpack.h gsl/gsl_fit.h hdf5.h H5Ipublic.h cairo.h cairo/cairo-svg.h \
    fftw3.h toml++/toml.h; do
  refuses dem/state/state.hpp "<$header>"
done
clean_tree  # the solver reached through a chain of headers
echo '#include "dem/disks/kernel/march.hpp"' >> "$root/dem/state/state_tools.hpp"
echo '#include "dem/state/state_tools.hpp"' >> "$root/analysis/counts.hpp"
if bash "$check" "$root" > /dev/null; then echo "accepted a chain to the solver"; exit 1; fi
clean_tree
echo '// AnyState' >> "$root/dem/systems.hpp"
bash "$check" "$root" > /dev/null || { echo "refused AnyState where it belongs"; exit 1; }
echo 'AnyState state;' >> "$root/dem/state/state.hpp"
if bash "$check" "$root" > /dev/null; then echo "accepted AnyState in a shared header"; exit 1; fi
