#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# To be sourced: a Slurm of one's own on the loopback interface, two nodes of one processor each on this
# machine, without systemd, accounting or control groups, for root or any user.
#   slurm_start FOLDER    starts it; SLURM_CONF is set
#   slurm_stop FOLDER     ends what slurm_start and slurm_node started, by process id
#   slurm_node FOLDER N0  starts the daemon of a node again

# Three ports in a row that nobody listens on.
free_ports() {
  local port
  for port in $(shuf -i 20000-60000 -n 50); do
    for offset in 0 1 2; do
      (exec 3<>"/dev/tcp/127.0.0.1/$((port + offset))") 2>/dev/null && continue 2
    done
    echo "$port"
    return
  done
  return 1
}

slurm_start() {
  local state=$1 user host port
  user=$(id -un) host=$(hostname -s) port=$(free_ports)
  mkdir -p "$state"/{munge,ctld,log,spool.n0,spool.n1}
  chmod 0755 "$state" "$state/munge"
  (umask 077; head -c 1024 /dev/urandom >"$state/munge/key")
  chmod 0400 "$state/munge/key"
  cat >"$state/slurm.conf" <<CONF
ClusterName=crowdface
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$state/munge/sock,cred_expire=5
CredType=cred/munge
SlurmctldPort=$port
SlurmctldPidFile=$state/ctld.pid
StateSaveLocation=$state/ctld
SlurmctldLogFile=$state/log/ctld.log
SlurmdSpoolDir=$state/spool.%n
SlurmdPidFile=$state/slurmd.%n.pid
SlurmdLogFile=$state/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$state/log/jobcomp.log
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=bf_interval=1,sched_interval=3,batch_sched_delay=1
ReturnToService=2
JobRequeue=1
RequeueExit=75
SlurmctldTimeout=10
InactiveLimit=0
KillWait=5
SlurmdTimeout=10
SlurmdParameters=config_overrides
NodeName=n0 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=4000 State=UNKNOWN
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=n0,n1 Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$state/slurm.conf
  munged --key-file="$state/munge/key" --socket="$state/munge/sock" --pid-file="$state/munge/pid" \
    --log-file="$state/munge/log" --seed-file="$state/munge/seed" --num-threads=2
  slurmctld -c -f "$SLURM_CONF"
  slurm_node "$state" n0
  slurm_node "$state" n1
  for _ in $(seq 150); do
    [ "$(sinfo -h -N -o %T 2>/dev/null | grep -c idle)" = 2 ] && return
    sleep 0.2
  done
  tail -n 5 "$state"/log/*.log "$state/munge/log"
  return 1
}

slurm_node() {
  slurmd -N "$2" -f "$1/slurm.conf"
}

slurm_stop() {
  local file pid
  scancel --user="$(id -un)" 2>/dev/null || true
  for file in "$1"/slurmd.n0.pid "$1"/slurmd.n1.pid "$1"/ctld.pid "$1"/munge/pid; do
    [ -f "$file" ] || continue
    pid=$(cat "$file")
    kill "$pid" 2>/dev/null || continue
    for _ in $(seq 50); do
      kill -0 "$pid" 2>/dev/null || break
      sleep 0.1
    done
    kill -9 "$pid" 2>/dev/null || true
  done
}
