#!/usr/bin/env bash
# submit.sh SCENE INPUT OUTPUT FIRST LAST [CHUNK] [-- BRUME OPTION...]
# Fogs a sequence on a Slurm cluster: an array of chunks of CHUNK frames (10), and a job that says what came of it.
#   submit.sh fog.json 'shot.####.exr' 'fogged/shot.####.exr' 1001 1240 20 -- --layers transmittance
# Environment: BRUME (the command), AT_ONCE (chunks running at a time, 50), SBATCH_... (sbatch's own).
# Asking again does what is missing. docs/farm.md has the rest.
set -euo pipefail
[ $# -ge 5 ] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
export FOG_SCENE=$1 FOG_INPUT=$2 FOG_OUTPUT=$3 FOG_FIRST=$4 FOG_LAST=$5; shift 5
export FOG_CHUNK=10 FOG_OPTIONS=
case "${1:---}" in --) ;; *) FOG_CHUNK=$1; shift ;; esac
[ "${1:-}" = -- ] && shift
[ $# -eq 0 ] || printf -v FOG_OPTIONS '%q ' "$@"
[ "$FOG_CHUNK" -ge 1 ] && [ "$FOG_LAST" -ge "$FOG_FIRST" ] || { echo "submit.sh: frames $FOG_FIRST to $FOG_LAST by $FOG_CHUNK; expected at least one, by 1 or more" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export FOG_STATS=$(dirname "$FOG_OUTPUT")/stats
mkdir -p "$FOG_STATS"
# What is wrong with the request itself shows here, not in every chunk.
"${BRUME:-brume}" plan "$FOG_SCENE" "$FOG_INPUT" >"$FOG_STATS/plan.txt"

chunks=$(( (FOG_LAST - FOG_FIRST) / FOG_CHUNK ))
job=$(sbatch --parsable --export=ALL --array="0-$chunks%${AT_ONCE:-50}" --output="$FOG_STATS/chunk.%a.log" --open-mode=append "$here/chunk.sbatch")
job=${job%%;*}
merge=$(sbatch --parsable --export=ALL --dependency="afterany:$job" --output="$FOG_STATS/merge.log" "$here/merge.sbatch")
echo "job $job: $((chunks + 1)) chunks; job ${merge%%;*} merges $FOG_STATS/*.json into $FOG_STATS/all.json"
