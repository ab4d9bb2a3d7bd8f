#!/usr/bin/env bash
# Every measurement that docs/accuracy.md quotes, into out/bench/.
#   bench.sh [--quick]           all of them; --quick: the paper's default only, and few pictures
#   bench.sh trade [OPTION...]   error against time alone, see trade.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
if [ "${1:-}" = trade ]; then shift; exec tests/bench/trade.sh "$@"; fi
out=out/bench
mkdir -p "$out"
build/release/bin/filter_bench ${1:+"$1"} "$out/filter.json" "$out/filter.md"
build/release/bin/host_bench | tee "$out/host.md"
build/release/bin/airlight_accuracy ${1:+"$1"} "$out/airlight.json" "$out/airlight.md"
build/release/bin/airlight_bench ${1:+"$1"} "$out/airlight_speed.json" "$out/airlight_speed.md"
build/release/bin/maps_bench 353 1 353 3 3008 1 3008 3 3008 8 | tee "$out/maps.md"
build/release/bin/orders_bench samples/frames/street.0001.exr | tee "$out/orders.md"
build/release/bin/orders_bench samples/frames/street.0001.exr 3 | tee "$out/orders_1080p.md"
build/release/bin/lamps_bench samples/frames/street.0001.exr | tee "$out/lamps.md"
build/release/bin/map_bases | tee "$out/map_bases.md"
tests/bench/sequence_bench.sh build/release/bin/brume samples/frames "$out"
build/release/bin/surface_calibration ${1:+"$1"} | tee "$out/surface_calibration.txt"
build/release/bin/surface_bench | tee "$out/surface_bench.md"
build/release/bin/lamp_arrival ${1:+"$1"} | tee "$out/lamp_arrival.txt"
build/release/bin/slab_calibration ${1:+"$1"} | tee "$out/slab_calibration.txt"
build/release/bin/surface_accuracy ${1:+"$1"} | tee "$out/surface_accuracy.txt"
build/release/bin/quality_bench ${1:+"$1"} "$out/quality.json" "$out/quality.md"
tests/bench/trade.sh ${1:+"$1"}
build/release/bin/effect_tests --gtest_filter='Truth.*:Paper.*:*ResolutionInvariance*:*WholeFilter*' | grep -v '^\[' | tee "$out/accuracy.txt"
echo "in $out: $(ls "$out" | tr "\n" " ")"
