#!/usr/bin/env bash
# completion.sh COMPLETION WORK: what bash offers for lines that are typed in part.
set -euo pipefail
work=$2
source "$1"
rm -rf "$work"
mkdir -p "$work/a folder"
cd "$work"
touch scene.json 'shot 1.exr'
failed=0

offered() { # WORD...: the last is being typed
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _brume
  printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd '|'
}
expect() { # OFFERS WORD...
  local expected=$1 got; shift
  got=$(offered "$@")
  [ "$got" = "$expected" ] || { echo "$*: offers '$got'; expected '$expected'" >&2; failed=1; }
}
expect 'run' brume ru
expect 'schema|sheet|stats|sweep' brume s
expect '--help' brume --h
expect '--set|--skip-existing|--sky|--stats' brume run --s
expect '--quiet' brume run scene.json --qui
expect 'auto|cpu|gl' brume run --backend ''
expect 'cpu' brume run --backend = c
expect 'auto|cpu|gl' brume run --backend =
expect 'draft|final|reference|standard' brume plan scene.json --quality ''
expect 'scene.json|shot 1.exr' brume run s
expect 'scene.json|shot 1.exr' brume run --quiet s
expect 'a folder' brume run scene.json -o a
expect '' brume run --far s
expect 'paint' brume media pai
expect '--stroke' brume media paint --str
expect '' brume effects s
expect '--json' brume effects --j
# A file called like a command is none of it.
expect '--quiet' brume run media --qui
complete -p brume | grep -q _brume || { echo "brume: no completion is registered" >&2; failed=1; }
exit $failed
