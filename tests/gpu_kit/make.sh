#!/usr/bin/env bash
# make.sh BUILD ARCHIVE: packs what BUILD made of the GL tests and the benches, with every library that they load but a driver's,
# into an archive for a Linux machine that has a GPU's driver and nothing else. There: tar xf ARCHIVE && brume-gpu-kit/run.sh
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1 archive=$2
programs=(gl_tests gl_abi_tests effect_tests filter_bench airlight_bench)
. "$here/../packages/libraries.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
kit=$work/brume-gpu-kit
mkdir -p "$kit"/bin "$kit"/lib/brume
cp "$here/run.sh" "$kit/"
for program in "${programs[@]}"; do cp "$build/bin/$program" "$kit/bin/"; done
cp -L "$build/lib/libbrume.so.0" "$kit/lib/"
cp "$build"/lib/brume/*.so "$kit/lib/brume/"
strip --strip-unneeded "$kit"/bin/* "$kit"/lib/*.so* "$kit"/lib/brume/*

collect_libraries "$kit" "$kit"/bin/* "$kit"/lib/brume/* >/dev/null
tar -C "$work" -cJf "$archive" brume-gpu-kit
size=$(stat -c %s "$archive")
echo "$archive: $((size / 1024)) KiB"
if [ "$size" -gt $((50 << 20)) ]; then echo "$archive: expected 51200 KiB at most" >&2; exit 1; fi
