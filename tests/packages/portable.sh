#!/usr/bin/env bash
# portable.sh BUILD OUT WORK: packs the command that is in BUILD, with every library that it loads, into OUT/brume-VERSION-linux-x86_64.tar.xz,
# and fogs a frame with it where there is no library at all, then where there is C's, then C++'s. As root, for chroot.
set -euo pipefail
build=$(realpath "$1") out=$(realpath -m "$2") work=$(realpath -m "$3")
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
. "$here/libraries.sh"
fail() { echo "$*" >&2; exit 1; }

rm -rf "$work"
mkdir -p "$work/stage" "$out"
for component in runtime tool; do cmake --install "$build" --prefix "$work/stage" --component $component --strip >/dev/null; done
name=brume-$("$build/bin/brume" --version | cut -d ' ' -f 2)-linux-x86_64
kit=$work/$name
mkdir -p "$kit"/{bin,lib,libexec,share/doc/libraries}
cp "$source/cmake/portable/brume" "$kit/bin/"
cp "$work/stage/bin/brume" "$kit/libexec/"
libraries=$(dirname "$(find "$work/stage" -name 'libbrume.so.0')")
cp -L "$libraries/libbrume.so.0" "$kit/lib/"
cp -r "$libraries/brume" "$libraries/brume-modules/brume-vdb.so" "$kit/lib/"
cp -r "$work/stage/share/man" "$work/stage/share/bash-completion" "$kit/share/"
cp "$source/README.md" "$source/LICENSE" "$source/CHANGELOG.md" "$kit/"
# Of whom they are, and on what terms.
for library in $(collect_libraries "$kit" "$kit/libexec/brume" "$kit"/lib/libbrume.so.0 "$kit"/lib/brume-vdb.so "$kit"/lib/brume/*); do
  package=$(dpkg -S "$(realpath "$library")" 2>/dev/null || dpkg -S "$library") || fail "$library: of no package"
  cp -L "/usr/share/doc/${package%%:*}/copyright" "$kit/share/doc/libraries/${package%%:*}"
done
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@${SOURCE_DATE_EPOCH:-$(date +%s)}" -cJf "$out/$name.tar.xz" "$name"
echo "$out/$name.tar.xz: $(($(stat -c %s "$out/$name.tar.xz") / 1024)) KiB"

# A machine: a shell that is linked statically, and frames.
root=$work/root
mkdir -p "$root"/{bin,opt,tmp,work,dev,lib64,lib/x86_64-linux-gnu}
(cd "$work" && apt-get download -qq -o APT::Sandbox::User=root busybox-static >/dev/null && dpkg-deb -x busybox-static_*.deb busybox)
cp "$(find "$work/busybox" -name busybox -type f -perm -1)" "$root/bin/busybox"
for applet in sh dirname readlink; do ln -s busybox "$root/bin/$applet"; done
mknod -m 666 "$root/dev/null" c 1 3
tar -C "$root/opt" -xJf "$out/$name.tar.xz"
ln -s "../opt/$name/bin/brume" "$root/bin/brume"
cp "$source/samples/frames/street.json" "$source/samples/frames/street.0001.exr" "$root/work/"
(cd "$root/work" && "$build/bin/brume" run street.json street.0001.exr -o expected.exr --backend cpu --quiet)
fogs() { # WHERE
  rm -f "$root/work/fogged.exr"

  chroot "$root" /bin/sh -c 'PATH=/bin; cd /work && brume run street.json street.0001.exr -o fogged.exr --backend cpu --quiet'
  cmp "$root/work/fogged.exr" "$root/work/expected.exr" || fail "$1: another picture than that of $build"
  echo "runs $1"
}
fogs "without any library"
cp "$kit"/runtime/c/* "$root/lib/x86_64-linux-gnu/"
cp "$kit/runtime/c/ld-linux-x86-64.so.2" "$root/lib64/"
fogs "with the C library"
rm -r "$root/opt/$name/runtime/c"
fogs "with the C library in place of the archive's"
cp "$kit"/runtime/c++/* "$root/lib/x86_64-linux-gnu/"
rm -r "$root/opt/$name/runtime"
fogs "with the C and C++ libraries in place of the archive's"
rm -rf "$root"
