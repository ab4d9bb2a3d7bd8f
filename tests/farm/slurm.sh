#!/usr/bin/env bash
# slurm.sh TOOL FARM SCENE FRAMES WORK: samples/farm on a Slurm of its own, on loopback: slurmctld, slurmd and munged, as root.
# An array over 8 frames, one command of which is killed (kill -9) and tried again, ends with all frames, the bytes of a plain
# run, and one file of statistics that says so.
set -euo pipefail
tool=$1 farm=$2 scene=$3 frames=$4 work=$5
rm -rf "$work"
mkdir -p "$work"/{spool,state,plain,fogged} && chmod 755 "$work"
work=$(cd "$work" && pwd)
fail() { echo "slurm.sh: $1"; tail -n 20 "$work"/*.log "$work"/fogged/stats/*.log 2>/dev/null; exit 1; }
waits_for() { # SECONDS WHAT COMMAND...
  local until=$((SECONDS + $1)) what=$2; shift 2
  until "$@" >/dev/null 2>&1; do
    [ $SECONDS -lt $until ] || fail "no $what in time"
    sleep 0.2
  done
}

PATH=$PATH:/usr/sbin
ports=$((20000 + $$ % 20000))
head -c 1024 /dev/urandom >"$work/munge.key" && chmod 400 "$work/munge.key"
export SLURM_CONF=$work/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=loopback
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
SlurmctldPort=$ports
SlurmdPort=$((ports + 1))
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1
MpiDefault=none
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=8 RealMemory=20000
PartitionName=fog Nodes=ALL Default=YES State=UP
CONF
daemons=()
end() { kill "${daemons[@]}" 2>/dev/null || true; wait 2>/dev/null || true; }
trap end EXIT
munged --foreground --force --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munge.pid" \
  --log-file="$work/munge.log" --seed-file="$work/munge.seed" >"$work/munged.log" 2>&1 & daemons+=($!)
waits_for 10 munged test -S "$work/munge.socket"
slurmctld -D >"$work/controller.log" 2>&1 & daemons+=($!)
slurmd -D >"$work/node.log" 2>&1 & daemons+=($!)
idle() { [ "$(sinfo -h -o %T)" = idle ]; }
waits_for 30 "node that is idle" idle

export BRUME=$tool FOG_PAUSE=1
cd "$work"
"$tool" run "$scene" "$frames" -o plain/shot.####.exr --frames 1-8 --backend cpu --quiet
"$farm/submit.sh" "$scene" "$frames" "$work/fogged/shot.####.exr" 1 8 2 -- --backend cpu --quiet
running() { pgrep -f "^$tool run .* --frames 3-4 " >"$work/running"; }
waits_for 60 "second chunk" running
xargs kill -9 <"$work/running" || fail "the second chunk had ended before it could be killed"
ended() { [ -z "$(squeue -h)" ]; }
waits_for 120 "end of the jobs" ended

for frame in 0001 0002 0003 0004 0005 0006 0007 0008; do
  cmp -s "plain/shot.$frame.exr" "fogged/shot.$frame.exr" || fail "frame $frame is not the bytes of a plain run"
done
"$tool" stats fogged/stats/all.json --frames 1-8 >"$work/merged.log" || fail "the merged statistics do not say that all frames are done"
ls fogged/stats/*.0001.2.json >/dev/null 2>&1 || fail "the chunk that was killed was not tried again"
echo "8 frames in 4 chunks, one killed and tried again: all there, the bytes of a plain run"
