#!/usr/bin/env bash
# abidiff.sh LIBRARY FROZEN CURRENT WORK CC NM: LIBRARY has all functions of the header FROZEN, and libabigail finds in CURRENT nothing
# that breaks who was compiled with FROZEN: functions and fields may be added, these at the ends of structs.
# No library of an old version is kept or can be built anew everywhere, so that headers are compared: each function becomes a variable
# of its pointer's type, whose debug information has the types of all that it takes, and each number a pointer to so many bytes.
set -euo pipefail
library=$1 frozen=$(realpath "$2") current=$(realpath "$3") work=$4 cc=$5 nm=$6
mkdir -p "$work"
failed=0
fail() { echo "$*" >&2; failed=1; }

functions_of() { # HEADER
  sed -n 's/^BRUME_API .*[ *]\(brume_[a-z0-9_]*\)(.*/\1/p' "$1" | sort -u
}
numbers_of() { # HEADER: but those that may grow
  sed -n 's/^#define \(BRUME_[A-Z0-9_]*\) \(0x[0-9a-fA-F]*\|[0-9][0-9]*\)u\?\( .*\|$\)/\1/p' "$1" | grep -v -e VERSION -e MAX -e ABI
}
describe() { # HEADER NAME: WORK/NAME.so, of the header's types
  { printf '#include "%s"\n' "$1"
    for function in $(functions_of "$1"); do printf '__typeof__(&%s) abi_%s;\n' "$function" "$function"; done
    for number in $(numbers_of "$1"); do printf 'char (*abi_%s)[1 + (%s)];\n' "$number" "$number"; done
  } >"$work/$2.c"
  "$cc" -std=gnu99 -g -fPIC -shared -nostdlib -o "$work/$2.so" "$work/$2.c"
}
cat >"$work/allowed.abignore" <<'EOF'
[suppress_type]
  type_kind = struct
  has_data_member_inserted_at = end
EOF
holds() { # OLD NEW
  abidiff --no-added-syms --suppr "$work/allowed.abignore" "$work/$1.so" "$work/$2.so" >"$work/$2.txt" 2>&1
}

[ "$(functions_of "$frozen" | wc -l)" -ge 40 ] || fail "$frozen: expected to find its functions"
"$nm" -D --defined-only "$library" | awk '{sub("@.*", "", $3); print $3}' | sort >"$work/exported.txt"
for function in $(functions_of "$frozen"); do
  grep -qx "$function" "$work/exported.txt" || fail "$library: no $function, which $frozen declares"
done

describe "$frozen" frozen
describe "$current" current
holds frozen current || { fail "$current breaks clients of $frozen:"; cat "$work/current.txt" >&2; }

# That it would tell.
changed() { # NAME SED
  sed "$2" "$frozen" >"$work/$1.h"
  ! cmp -s "$work/$1.h" "$frozen" || fail "$1: the header has no such place"
  describe "$work/$1.h" "$1"
}
breaks() { changed "$@"; ! holds frozen "$1" || fail "$1: expected abidiff to tell"; }
breaks removed '/^BRUME_API .* brume_plan_execute(/s/brume_plan_execute/brume_plan_run/'
breaks argument '/^BRUME_API .* brume_plan_execute(/s/brume_frame \*frame/brume_image *frame/'
breaks field '/^typedef struct brume_frame {/,/^}/s/^  uint32_t struct_size;/&\n  double number;/'
breaks value 's/^#define BRUME_ERROR_ARGUMENT [0-9]*/#define BRUME_ERROR_ARGUMENT 77/'
changed grown '/^typedef struct brume_frame {/,/^} brume_frame;/s/^} brume_frame;/    const void *number;\n&/'
holds frozen grown || { fail "grown: expected a field at the end to be allowed"; cat "$work/grown.txt" >&2; }
exit $failed
