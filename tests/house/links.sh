#!/usr/bin/env bash
# links.sh ROOT: every relative link and picture of README.md and of the pages under docs/ leads to a file of the repository,
# and every file of a room that they name in `backticks` exists (a pattern such as `tests/bench/*.py` must match one).
set -euo pipefail
cd "$1"
bad=0
[[ -f README.md ]] || { echo "no README.md in $1"; exit 1; }
rooms='tests|data|docs|apps|dem|analysis|geometry'
while IFS= read -r page; do
  while IFS= read -r link; do
    target=${link%%#*}
    case $target in '' | *://* | mailto:*) continue ;; esac
    if [[ ! -e $(dirname "$page")/$target ]]; then echo "$page: broken link $link"; bad=1; fi
  done < <(grep -oE '\]\([^) ]+\)' "$page" | sed -e 's/^](//' -e 's/)$//')
  # Words of inline code and of blocks alike, as commands name files among other words.
  while IFS= read -r file; do
    compgen -G "$file" > /dev/null || { echo "$page: no file $file"; bad=1; }
  done < <(awk '/^ *```/ {block = !block; next}
                block || /^    / {print; next}
                {n = split($0, part, "`"); for (k = 2; k <= n; k += 2) print part[k]}' "$page" |
           tr -s ' \t;|&()"=,' '\n' | sed "s/'//g" | grep -E "^($rooms)/[^ <>\$]+\.(csv|py|cpp|hpp|toml)\$" | sort -u)
done < <(printf 'README.md\n'; find docs -name '*.md' | sort)
exit $bad
