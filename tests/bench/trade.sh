#!/usr/bin/env bash
# The study of error against time into out/bench/trade.{json,md,svg,png}.
#   trade.sh [--quick] [--fresh] [--docs]
# --quick: few and small pictures. --fresh: random pictures that were not drawn before. --docs: also renews the tables of
# docs/accuracy.md and its plot.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=out/bench docs=
options=()
for option in "$@"; do
  if [ "$option" = --docs ]; then docs=1; else options+=("$option"); fi
done
mkdir -p "$out"
build/release/bin/trade "${options[@]}" ../shared samples "$out"
if [ -n "$docs" ]; then
  cp "$out/trade.png" docs/images/
  awk -v tables="$out/trade_short.md" '
    /^<!-- end of trade -->/ { skip = 0 }
    !skip { print }
    /^<!-- trade:/ { skip = 1; print ""; while ((getline line < tables) > 0) print line; print "" }' docs/accuracy.md >"$out/accuracy.md"
  mv "$out/accuracy.md" docs/accuracy.md
fi
echo "in $out: trade.json, trade.md, trade.svg, trade.png"
