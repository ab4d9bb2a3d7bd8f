#!/usr/bin/env bash
# pages.sh BRUME PAGES: every command and option of the help has its place in the manual, and mandoc finds no fault with it.
set -euo pipefail
brume=$1 pages=$2
failed=0
fail() { echo "$*" >&2; failed=1; }

command -v mandoc >/dev/null || { echo "no mandoc: expected Debian's package mandoc" >&2; exit 1; }
for page in "$pages"/man/man1/*.1 "$pages"/man/man5/*.5; do
  mandoc -T lint -W warning "$page" || failed=1
  gzip -dc "$page.gz" | cmp - "$page" || fail "$page.gz: expected what $page has"
done

subcommands() { # COMMAND...
  "$@" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z_-]*\) .*/\1/p'
}
check() { # PAGE COMMAND...
  local page=$pages/man/man1/$1.1 text option sub; shift
  [ -f "$page" ] || { fail "$page: missing"; return; }
  text=$(mandoc -T ascii "$page" | col -b)
  for option in $("$@" --help | sed -n 's/^  \(-[^ {]*\).*/\1/p' | tr ',' '\n'); do
    [[ $text =~ (^|[[:space:],])$option([[:space:],]|$) ]] || fail "$page: no $option"
  done
  for sub in $(subcommands "$@"); do
    [[ $text == *"$(basename "$page" .1)-$sub(1)"* ]] || fail "$page: no word of $sub"
    check "$(basename "$page" .1)-$sub" "$@" "$sub"
  done
}
check brume "$brume"
[ "$(ls "$pages"/man/man1/*.1 | wc -l)" -gt 20 ] || fail "$pages/man/man1: expected a page for each command"

# All keys of the schema, and of each effect.
scene=$(mandoc -T ascii -O width=1000 "$pages/man/man5/brume-scene.5" | col -b)
for key in brume metres_per_unit camera.vertical_fov 'medium.density[].falloff' 'lights[].shadow.file' environment.sh \
  quality.max_error; do
  [[ $scene == *"$key"* ]] || fail "brume-scene.5: no $key"
done
for parameter in $("$brume" effects | awk '/^[a-z]/ {effect = $1} /^  [a-z]/ && $2 != "layer" {print "effects." effect "." $1}'); do
  [[ $scene == *"$parameter"* ]] || fail "brume-scene.5: no $parameter"
done
exit $failed
