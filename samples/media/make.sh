#!/usr/bin/env bash
# Media for the street of samples/frames, made by hand with `brume media`, each with the scene that lights it:
#
#   steam.####.ply, steam.json      steam from a drain, as an emitter of 3000 particles has it at every frame
#   bank.ply, street_fog.json       a fog bank along the street: painted, sprayed against the houses, copied and erased
#
#   samples/media/make.sh [FOLDER]  (default: out/media). BRUME names the tool where it is not in build/release or the PATH.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
out=${1:-$root/out/media}
brume=${BRUME:-$root/build/release/bin/brume}
[ -x "$brume" ] || brume=brume
frame=$root/samples/frames/street.0001.exr
mkdir -p "$out"
rm -f "$out"/bank.ply "$out"/bank.ply.journal
cp "$here"/steam.json "$here"/street_fog.json "$out"

# Steam: it rises, is carried off by a little wind, spreads and thins.
"$brume" media emit "$out/steam.####.ply" --frames 1-20 --fps 12 --time 8 --seed 6 \
  --position=-3.7,9,0 --radius 0.1 --velocity=-0.15,0,0.8 --spread 0.1 --acceleration 0.06,0.01,-0.03 \
  --rate 500 --lifetime 6 --scale 10,2.6 --amplitude 0.12,0

# The bank lies on the street: strokes from the camera to where the street bends, wider and higher further on.
bank=$out/bank.ply
paint() { "$brume" media paint "$bank" --plane 0,0,1 "$@"; }
paint --seed 1 --plane-point 0,0,0.35 --radius 1.1 --amplitude 0.5 --stroke "-3,9,0 -2.6,30,0 -2.4,60,0"
paint --seed 2 --plane-point 0,0,0.3 --radius 1.1 --amplitude 0.5 --stroke "0.2,12,0 0.2,30,0 0.6,60,0"
paint --seed 3 --plane-point 0,0,0.35 --radius 1.1 --amplitude 0.5 --stroke "3,9,0 3,30,0 3.4,60,0"
paint --seed 4 --plane-point 0,0,0.9 --radius 2.2 --amplitude 0.35 --stroke "-1.5,34,0 1,48,0 0,74,0 3,95,0"
# A drift in the air, drawn on the first frame's screen onto a plane across the street.
"$brume" media paint "$bank" --seed 5 --frame "$frame" --screen-stroke "210,196 300,190 400,200" \
  --plane 0,1,0 --plane-point 0,24,0 --radius 0.9 --amplitude 0.3 --jitter 0.6
# Sprayed against the houses on the left, where it stays between wall and lamp posts; then some of it across the street.
"$brume" media airbrush "$bank" --seed 6 --frame "$frame" --position=-4.2,15,0.8 --velocity=-1.5,1,0 --spread 1 \
  --diffusion 0.25 --rate 40 --duration 8 --radius 0.6 --amplitude 0.2
"$brume" media copy "$bank" --frame "$frame" --rect 100,180,235,330 --by 9.5,9,0
# A gap behind the car that has just driven through.
"$brume" media erase "$bank" --stroke "0.8,14,0.6 0.8,27,0.6" --radius 2 --strength 0.6

"$brume" media info "$bank"
"$brume" media info "$out/steam.0001.ply"
