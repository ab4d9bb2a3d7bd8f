#!/usr/bin/env bash
# kills.sh TOOL SCENE FRAMES WORK [N=20]: a run that is killed N times at random moments (kill -9) and begun again. Whatever
# outputs there are after each are whole and the bytes of a run that nobody killed; beside them there are unfinished files only.
set -euo pipefail
tool=$1 scene=$2 frames=$3 work=$4 kills=${5:-20} range=1-8
rm -rf "$work"
mkdir -p "$work/whole" "$work/killed"
fog() { # FOLDER ARGUMENT...
  local folder=$1; shift
  exec "$tool" run "$scene" "$frames" -o "$work/$folder/shot.####.exr" --frames "$range" --backend cpu --quiet "$@"
}
fail() { echo "kills.sh: after kill $killed: $1"; exit 1; }
check() {
  local file name
  for file in "$work"/killed/* "$work"/killed/.[!.]*; do
    name=${file##*/}
    [ -e "$file" ] || continue
    case $name in
      .brume-*.partial) unfinished=$((unfinished + 1)) ;;
      shot.*.exr) cmp -s "$file" "$work/whole/$name" || fail "$name is not the bytes of a run that nobody killed" ;;
      *) fail "$name is nobody's" ;;
    esac
  done
}

killed=0 unfinished=0 ended=0 rounds=0 before=0 grew=0 seed=${SEED:-$$}
echo "seed $seed"
RANDOM=$seed
begin=$(date +%s%N)
(fog whole)
microseconds=$((($(date +%s%N) - begin) / 1000))
while [ "$killed" -lt "$kills" ]; do
  fog killed --skip-existing &
  child=$!
  after=$(((RANDOM * 32768 + RANDOM) % (microseconds * 3 / 4)))
  sleep "$((after / 1000000)).$(printf '%06d' $((after % 1000000)))"
  if kill -9 "$child" 2>/dev/null; then
    killed=$((killed + 1))
  fi
  # 137: killed; what ended first ended well.
  status=0
  wait "$child" 2>/dev/null || status=$?
  case $status in
    137) ;;
    0) ended=$((ended + 1)) ;;
    *) fail "status $status" ;;
  esac
  check
  there=$(find "$work/killed" -name 'shot.*.exr' | wc -l)
  [ "$there" -eq "$before" ] || grew=$((grew + 1))
  before=$there
  # All there: from the start again, so that kills go on hitting frames that are being written.
  if [ "$there" -eq 8 ]; then
    before=0
    rm -rf "$work/killed" && mkdir "$work/killed"
    rounds=$((rounds + 1))
  fi
done
# Over the unfinished files of the last kills.
(fog killed --skip-existing)
check
for file in "$work"/whole/*.exr; do
  cmp "$file" "$work/killed/${file##*/}"
done
echo "$killed kills of runs of $((microseconds / 1000)) ms, $grew of them after frames had been written, $ended runs ended before theirs;"
echo "$rounds times all frames were there; unfinished files, counted after each kill: $unfinished"
# Else nothing was tried.
[ "$grew" -gt 0 ] || fail "no run had come to write a frame"
