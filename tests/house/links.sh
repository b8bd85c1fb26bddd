#!/usr/bin/env bash
# links.sh ROOT: every relative link and picture of README.md and docs/*.md leads to a file of the repository.
set -euo pipefail
cd "$1"
bad=0
shopt -s nullglob
[[ -f README.md ]] || { echo "no README.md in $1"; exit 1; }
for page in README.md docs/*.md; do
  while IFS= read -r link; do
    target=${link%%#*}
    case $target in '' | *://* | mailto:*) continue ;; esac
    if [[ ! -e $(dirname "$page")/$target ]]; then echo "$page: broken link $link"; bad=1; fi
  done < <(grep -oE '\]\([^) ]+\)' "$page" | sed -e 's/^](//' -e 's/)$//')
done
exit $bad
