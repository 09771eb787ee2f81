#!/usr/bin/env bash
# The printed script on a real Slurm of one machine: an array that is requeued, preempted and loses a node still ends in the
# dataset that one process makes. Needs root, as Slurm does. Usage: tests/engines/slurm.sh [ENSONIFY]
set -euo pipefail
here=$(cd "$(dirname "$0")/../.." && pwd)
ensonify=$(realpath "${1:-$here/target/release/ensonify}")
work=$(mktemp -d)
say() { printf -- '-- %s\n' "$*"; }
fail() { say "FAILED: $*"; tail -n 30 "$work"/*.log "$work"/*/*.log 2>/dev/null || true; exit 1; }

if ! command -v slurmctld >/dev/null || ! command -v munged >/dev/null; then
  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends slurm-wlm munge >/dev/null
fi
say "Slurm $(slurmctld -V)"

# One controller, two nodes on this host, a partition that preempts the other.
host=$(hostname -s)
mkdir -p "$work"/{state,spool-n1,spool-n2,job} /etc/slurm /run/munge /var/log/munge /var/lib/munge
cat > "$work/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=16817
AuthType=auth/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
JobRequeue=1
KillWait=10
SlurmdTimeout=10
SchedulerParameters=sched_interval=2,bf_interval=2
SlurmctldParameters=preempt_send_user_signal
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=17001 CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=17002 CPUs=1 RealMemory=1000
PartitionName=main Nodes=n1,n2 Default=YES PriorityTier=1 PreemptMode=REQUEUE GraceTime=5
PartitionName=urgent Nodes=n1,n2 PriorityTier=10 PreemptMode=OFF
CONF
ln -sf "$work/slurm.conf" /etc/slurm/slurm.conf
export SLURM_CONF="$work/slurm.conf"
[ -s /etc/munge/munge.key ] || { mkdir -p /etc/munge; dd if=/dev/urandom of=/etc/munge/munge.key bs=1024 count=1 status=none; }
chown -R munge:munge /etc/munge /run/munge /var/log/munge /var/lib/munge
chmod 400 /etc/munge/munge.key
stop() {
  kill "${waits:-}" 2>/dev/null || true
  pkill -f "sbatch --wait job.sh" || true
  scancel --user=root 2>/dev/null || true
  for pid in "$work"/*.pid; do [ -f "$pid" ] && kill "$(cat "$pid")" 2>/dev/null || true; done
  pkill -x munged || true
  sleep 1
  rm -f /etc/slurm/slurm.conf
  rm -rf "$work"
}
trap stop EXIT
pgrep -x munged >/dev/null || runuser -u munge -- munged --force
slurmctld -f "$work/slurm.conf"
for node in n1 n2; do slurmd -f "$work/slurm.conf" -N "$node"; done
for _ in $(seq 150); do [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ] && break; sleep 0.2; done
[ "$(sinfo -h -t idle -o %D)" = 2 ] || fail "the nodes do not come up"
sinfo

# What one process makes of the recipe.
cd "$work/job"
cp "$here/tests/engines/recipe.yaml" .
ln -s "$here/catalogs" catalogs
"$ensonify" run recipe.yaml -o alone >/dev/null 2>&1
hash() { sed -n 's/.*"dataset_hash": "\(.*\)",/\1/p' "$1/manifest.json"; }

export ENSONIFY="$ensonify"
"$ensonify" job slurm recipe.yaml --shards 8 --cpus 1 --memory 400M --time 00:10:00 -o out > job.sh
say "sbatch --wait job.sh"
( code=0; sbatch --wait job.sh > sbatch.out 2>&1 || code=$?; echo "$code" > sbatch.code ) &
waits=$!
id=""
for _ in $(seq 50); do id=$(sed -n 's/^Submitted batch job //p' sbatch.out 2>/dev/null); [ -n "$id" ] && break; sleep 0.1; done
[ -n "$id" ] || fail "not submitted: $(cat sbatch.out)"
running() { squeue -h -r -j "$id" -t RUNNING -o %K 2>/dev/null; }
await_running() { for _ in $(seq 300); do [ -n "$(running)" ] && return; sleep 0.1; done; fail "no task runs"; }

await_running
task=$(running | head -n 1)
say "task $task is requeued"
sleep 1
scontrol requeue "${id}_$task"

# A requeued task waits two minutes by itself.
at_once() { for t in $(squeue -h -r -j "$id" -t PENDING -o %K); do scontrol update "JobId=${id}_$t" StartTime=now 2>/dev/null || true; done; }
sleep 2; at_once; await_running
say "another partition preempts: $(running | tr '\n' ' ')"
sbatch --partition=urgent --array=0-1 --mem=100M --job-name=urgent --output=/dev/null --wrap="sleep 3" > urgent.out
sleep 8; at_once; await_running

node=$(squeue -h -r -j "$id" -t RUNNING -o %N | head -n 1)
say "slurmd of $node is killed with its task"
pkill -KILL -f "slurmstepd.*$id" || true
kill -KILL "$(cat "$work/slurmd-$node.pid")"
sleep 12
slurmd -f "$work/slurm.conf" -N "$node"

while kill -0 "$waits" 2>/dev/null; do at_once; sleep 2; done
[ "$(cat sbatch.code)" = 0 ] || fail "sbatch --wait gives $(cat sbatch.code)"
say "the array is done: $(grep -h "stopping\|going on" ./*.log | sort | uniq -c | tr '\n' ';')"
for _ in $(seq 300); do [ -f out/SHA256SUMS ] && [ -z "$(squeue -h -n small-finish)" ] && break; sleep 0.2; done
[ -f out/SHA256SUMS ] || fail "the finishing job did not run"
( cd out && sha256sum --quiet -c SHA256SUMS ) || fail "sums"
[ "$(hash out)" = "$(hash alone)" ] || fail "the hash is $(hash out), not $(hash alone)"
grep -qi "requeuing" "$work/slurmctld.log" || fail "nothing was requeued"
say "the hash is that of one process: $(hash out)"
