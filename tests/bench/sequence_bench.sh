#!/usr/bin/env bash
# `brume run` over the demo sequence resized to 1080p, against oiiotool copying the same files: wall and CPU time.
#   sequence_bench.sh BRUME FRAMES OUT_FOLDER
set -euo pipefail
brume=$1 frames=$2 out=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out" "$work/in" "$work/copy" "$work/fog"
count=8
for i in $(seq 1 $count); do
  n=$(printf %04d "$i")
  # Bilinear colour, nearest depth: distances are never averaged.
  oiiotool "$frames/street.$n.exr" --ch R,G,B,A --resize:filter=triangle 1920x1080 \
    "$frames/street.$n.exr" --ch Z --resample:interp=0 1920x1080 --chappend \
    --compression zip -d R=half -d G=half -d B=half -d A=half -d Z=float -o "$work/in/street.$n.exr"
done
timed() { # LABEL COMMAND...
  local label=$1; shift
  /usr/bin/env bash -c 'TIMEFORMAT="%R %U %S"; time "$@" >/dev/null' _ "$@" 2>"$work/time"
  tail -n 1 "$work/time" | awk -v label="$label" -v n=$count '{printf "%s %.3f %.3f\n", label, $1 / n, ($2 + $3) / n}'
}
copy_all() { for f in "$1"/*.exr; do oiiotool "$f" -o "$2/$(basename "$f")"; done; }
export -f copy_all
for round in 1 2 3; do
  timed copy bash -c 'copy_all "$0" "$1"' "$work/in" "$work/copy"
  timed fog "$brume" run "$frames/street.json" "$work/in/street.####.exr" -o "$work/fog/street.####.exr" --backend cpu --quiet
done | sort -k1,1 -k3,3n >"$work/figures"
awk '{n[$1]++; wall[$1, n[$1]] = $2; cpu[$1, n[$1]] = $3}
     END {printf "| 1080p, half, zip | wall s / frame | CPU s / frame |\n|---|---|---|\n";
          printf "| oiiotool copy | %.2f | %.2f |\n| brume run (its defaults, CPU) | %.2f | %.2f |\n| ratio | %.2f | %.2f |\n",
                 wall["copy", 2], cpu["copy", 2], wall["fog", 2], cpu["fog", 2], wall["fog", 2] / wall["copy", 2], cpu["fog", 2] / cpu["copy", 2]}' \
  "$work/figures" | tee "$out/sequence.md"
