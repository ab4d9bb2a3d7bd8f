#!/usr/bin/env bash
# make.sh BUILD ARCHIVE: packs what BUILD made of the GL tests and the benches, with every library that they load but a driver's,
# into an archive for a Linux machine that has a GPU's driver and nothing else. There: tar xf ARCHIVE && brume-gpu-kit/run.sh
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1 archive=$2
programs=(gl_tests gl_abi_tests effect_tests filter_bench airlight_bench)
# Loaded by name when OpenGL is first asked for.
dispatch=(libEGL.so.1 libGL.so.1 libOpenGL.so.0 libGLX.so.0 libGLdispatch.so.0)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
kit=$work/brume-gpu-kit
mkdir -p "$kit"/{bin,lib/brume,runtime/c++,runtime/c}
cp "$here/run.sh" "$kit/"
for program in "${programs[@]}"; do cp "$build/bin/$program" "$kit/bin/"; done
cp -L "$build/lib/libbrume.so.0" "$kit/lib/"
cp "$build"/lib/brume/*.so "$kit/lib/brume/"
strip --strip-unneeded "$kit"/bin/* "$kit"/lib/*.so* "$kit"/lib/brume/*

needed() { # FILE...: libraries that they load, as paths
  ldd "$@" | awk '$2 == "=>" && $3 ~ /^\// {print $3} $1 ~ /^\/.*ld-linux/ {print $1}' | sort -u
}
found=$(for name in "${dispatch[@]}"; do ldconfig -p | awk -v name="$name" '$1 == name && /x86-64/ {print $NF; exit}'; done)
for library in $found $(needed "$kit"/bin/* "$kit"/lib/brume/* $found); do
  case $(basename "$library") in
    libbrume.so.*) continue ;;
    # A driver may need newer ones than these: run.sh takes them only where the machine's do not serve.
    libstdc++.so.*|libgcc_s.so.*) to=runtime/c++ ;;
    ld-linux*|libc.so.*|libm.so.*|libdl.so.*|libpthread.so.*|librt.so.*) to=runtime/c ;;
    *) to=lib ;;
  esac
  cp -L "$library" "$kit/$to/"
done
tar -C "$work" -cJf "$archive" brume-gpu-kit
size=$(stat -c %s "$archive")
echo "$archive: $((size / 1024)) KiB"
if [ "$size" -gt $((50 << 20)) ]; then echo "$archive: expected 51200 KiB at most" >&2; exit 1; fi
