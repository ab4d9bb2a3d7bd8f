#!/usr/bin/env bash
# debian.sh PACKAGES WORK: holds the .debs in PACKAGES against Debian's policy, then installs them into a Debian 12 that has nothing
# else, and fogs, computes and compiles there. As root, with a network.
set -euo pipefail
packages=$(realpath "$1") work=$(realpath -m "$2")
source=$(cd "$(dirname "$0")/../.." && pwd)
root=$work/root
fail() { echo "$*" >&2; exit 1; }
say() { echo "== $*"; }

say "lintian"
# Packages that no archive takes close no bugs of its, CPack writes the postinst, and OpenFX says where its hosts look.
lintian --allow-root --fail-on error,warning \
  --suppress-tags initial-upload-closes-no-bugs,maintscript-calls-ldconfig,non-standard-dir-in-usr,file-in-unusual-dir "$packages"/*.deb

say "what is in them"
rm -rf "$work"
mkdir -p "$work/files"
for deb in "$packages"/*.deb; do dpkg-deb -x "$deb" "$work/files"; done
! grep -rlF "$source" "$work/files" || fail "files of packages name $source; expected nothing of the build tree"
find "$work/files" -type f \( -name '*.so*' -o -path '*/bin/*' \) | while read -r file; do
  paths=$(readelf -d "$file" | sed -n 's/.*R\(UN\)\?PATH.*\[\(.*\)\]/\2/p' | tr ':' '\n')
  ! grep -v '^$ORIGIN/' <<<"$paths" | grep . || fail "$file: expected a search path below \$ORIGIN"
done
[ "$(dpkg-deb -f "$packages"/brume_*.deb Depends | grep -o 'libbrume0 ([^)]*)')" = "libbrume0 (= $(dpkg-deb -f "$packages"/libbrume0_*.deb Version))" ] ||
  fail "brume: expected to depend on its own libbrume0"
if command -v blender >/dev/null; then
  BLENDER_USER_SCRIPTS=$work/files/usr/share/blender/scripts PYTHONDONTWRITEBYTECODE=1 blender -b --factory-startup --python-exit-code 3 \
    --python-expr "import addon_utils; assert addon_utils.enable('brume_fog')" >"$work/blender.txt" 2>&1 || { cat "$work/blender.txt"; fail "Blender does not enable the add-on"; }
fi

say "a clean Debian 12"
mmdebstrap --quiet --variant=apt bookworm "$root"
cp /etc/resolv.conf "$root/etc/resolv.conf"
# Bash makes files of pipes by it.
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
mkdir "$root/debs" "$root/work"
cp "$packages"/*.deb "$root/debs/"
cp "$source"/samples/frames/street.json "$source"/samples/frames/street.000[12].exr "$root/work/"
cp "$source/docs/images/street_fog.png" "$root/work/picture.png"
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin HOME=/root LC_ALL=C.UTF-8 bash -euo pipefail -c "$1"; }
add() { # PACKAGE...: of ours as far as they are
  local wanted=() name
  for name in "$@"; do
    if ls "$root/debs/${name}"_*.deb >/dev/null 2>&1; then wanted+=("$(cd "$root" && ls debs/"${name}"_*.deb)"); else wanted+=("$name"); fi
  done
  inside "apt-get -qq update; cd /; DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ${wanted[*]/#debs/./debs} >/dev/null 2>/var/log/added.txt || { cat /var/log/added.txt; exit 1; }"
}

say "the command, on EXR frames"
add libbrume0 brume
inside 'brume --version; brume effects' >"$work/effects.txt"
for effect in airlight multiscatter surface; do grep -q "^$effect " "$work/effects.txt" || fail "no effect $effect in the package"; done
inside "cd /work; brume run street.json 'street.####.exr' -o 'fogged/street.####.exr' --quiet
  ! brume compare fogged/street.0001.exr street.0001.exr --max-relmse 1e-4 >/dev/null"
inside 'cd /work; ! brume info picture.png 2>said.txt; grep brume-image said.txt'
inside 'test -f /usr/share/man/man1/brume-run.1.gz; source /usr/share/bash-completion/completions/brume; COMP_WORDS=(brume sh) COMP_CWORD=1; _brume; [ "${COMPREPLY[*]}" = sheet ]'

say "brume-image: other pictures"
add brume-image
inside "cd /work; brume compare picture.png picture.png >/dev/null; brume sheet 'street.####.exr' 'fogged/street.####.exr' -o street.png; test -s street.png"

say "python3-brume"
add python3-brume
inside "cd /; python3 -c \"
import numpy, brume
print(brume.version(), brume.load())
fogged = brume.fog(numpy.ones((9, 16, 3), 'f'), numpy.full((9, 16), 30, 'f'), {'camera': {'vertical_fov': 50}, 'medium': {'absorption': 0.1}}, backend='cpu')
assert fogged.max() < 0.1, fogged\""

say "libbrume-dev: a program and an effect"
add libbrume-dev libglm-dev g++ cmake make pkg-config
inside 'cp -r /usr/share/doc/libbrume-dev/examples /work/; cd /work/examples
  for sample in minimal_c third_party_plugin; do cmake -S $sample -B /work/$sample >/dev/null; make -s -C /work/$sample >/dev/null; done
  /work/minimal_c/minimal_c /work/fog.ppm
  cc minimal_c/main.c -o /work/by_pkg_config $(pkg-config --cflags --libs brume) -lm; /work/by_pkg_config /work/again.ppm; cmp /work/fog.ppm /work/again.ppm'

say "taken away again"
inside 'apt-get purge -y -qq libbrume0 brume brume-image python3-brume libbrume-dev >/dev/null 2>&1
  left=$(find /usr /etc /var/lib/dpkg/info -name "*brume*"); [ -z "$left" ] || { echo "left: $left"; exit 1; }'
umount "$root/proc"
trap - EXIT
rm -rf "$root"
say "all is well"
