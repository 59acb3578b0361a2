# A Slurm cluster of two nodes, one and two, on this machine: daemons, ports, keys and state of its own.

cluster=""
declare -A daemons=()

skip() { echo "SKIPPED: $*"; exit 77; }

skipUnlessPossible() {
  local program
  for program in munged slurmctld slurmd sbatch squeue scontrol sinfo; do
    command -v "$program" > /dev/null || skip "$program is not installed (packages: slurm-wlm, munge)"
  done
  ((EUID == 0)) || skip "Slurm's daemons need root here"
}

# waitFor WHAT COMMAND...: for an event, which takes as long as the machine is busy with other things. The limit is only
# there to end what will never come.
waitFor() {
  local limit=$((SECONDS + 1500)) what=$1
  shift
  until "$@"; do
    ((SECONDS < limit)) || fail "waited in vain for $what"
    sleep 0.2
  done
}

# The first of three neighbouring ports that nobody listens on.
freePorts() {
  local first port
  for ((;;)); do
    first=$((20000 + RANDOM % 12000))
    for port in "$first" $((first + 1)) $((first + 2)); do
      (exec 3<> "/dev/tcp/127.0.0.1/$port") 2> /dev/null && continue 2
    done
    echo "$first"
    return
  done
}

startCluster() {
  cluster=$(mktemp -d /tmp/acentric-slurm-XXXXXX)
  local host port
  host=$(hostname)
  port=$(freePorts)
  mkdir "$cluster/state"
  (umask 077 && head -c 1024 /dev/urandom > "$cluster/munge.key")
  # A lost node is to be noticed soon, and its task started again then: credentials expire after twenty seconds,
  # before which a task is not requeued. A daemon of a busy machine must be able to answer within these times.
  # Ended jobs are remembered for a day: their states are asked for when all have ended.
  cat > "$cluster/slurm.conf" <<CONF
ClusterName=acentric
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$cluster/munge.socket,cred_expire=20
CredType=cred/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser=root
SlurmdUser=root
SlurmctldPort=$port
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.%n.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_min_interval=1000,bf_interval=1
SlurmdTimeout=30
MinJobAge=86400
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=bake Nodes=one,two Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$cluster/slurm.conf
  munged --foreground --force --socket="$cluster/munge.socket" --key-file="$cluster/munge.key" \
    --pid-file="$cluster/munged.pid" --log-file="$cluster/munged.log" --seed-file="$cluster/munged.seed" \
    > /dev/null 2>&1 &
  daemons[munged]=$!
  waitFor "munged" test -S "$cluster/munge.socket"
  slurmctld -c -D -f "$SLURM_CONF" > /dev/null 2>&1 &
  daemons[slurmctld]=$!
  local node
  for node in one two; do
    slurmd -D -N "$node" -f "$SLURM_CONF" > /dev/null 2>&1 &
    daemons[$node]=$!
  done
  disown -a
  waitFor "the nodes" nodesIdle
}

nodesIdle() { [[ $(sinfo --noheader --format=%T%D 2> /dev/null) == idle2 ]]; }

# What was started under this cluster's configuration, whoever its parent is by now.
processesOfCluster() {
  local environment
  for environment in /proc/[0-9]*/environ; do
    grep -qzxF "SLURM_CONF=$cluster/slurm.conf" "$environment" 2> /dev/null && echo "${environment//[!0-9]/}"
  done
  return 0
}

variableOf() { tr '\0' '\n' < "/proc/$1/environ" 2> /dev/null | sed -n "s/^$2=//p"; }

# The process of the program that bakes on a node.
bakingOn() {
  local process
  for process in $(processesOfCluster); do
    [[ $(readlink "/proc/$process/exe") == "$acentric" && $(variableOf "$process" SLURMD_NODENAME) == "$1" ]] || continue
    echo "$process"
    return 0
  done
  return 1
}
hasMapped() { grep -qF -- "$2" "/proc/$1/maps" 2> /dev/null; }
# Stops two programs while they bake, $killed on node one and $orphan on node two. Not yet: 1, and both go on.
holdOneOfEachNode() {
  killed=$(bakingOn one) && orphan=$(bakingOn two) || return 1
  hasMapped "$killed" .acscene && hasMapped "$orphan" .acscene || return 1
  kill -STOP "$killed" "$orphan" 2> /dev/null || true
  [[ $(readlink "/proc/$killed/exe") == "$acentric" && $(readlink "/proc/$orphan/exe") == "$acentric" ]] && return 0
  kill -CONT "$killed" "$orphan" 2> /dev/null || true
  return 1
}

# killNode NODE PROGRAM: the daemon, and the process that looks after the task whose program this is; the
# program itself and its script live on.
killNode() {
  local process=$2
  until [[ $(< "/proc/$process/comm") == slurmstepd ]]; do
    process=$(parentOf "$process")
    ((process > 1)) || fail "process $2 belongs to no task"
  done
  kill -9 "${daemons[$1]}" "$process"
}
parentOf() { sed -n 's/^PPid:[[:space:]]*//p' "/proc/$1/status"; }

fieldOf() { scontrol --oneliner show job "$1" | tr ' ' '\n' | sed -n "s/^$2=//p" | sed -n 1p; }
stateOf() { fieldOf "$1" JobState; }
jobsEnded() { [[ -z $(squeue --noheader 2> /dev/null) ]] && squeue --noheader > /dev/null 2>&1; }

showLogs() {
  [[ -n $cluster ]] || return 0
  squeue 2> /dev/null || true
  tail -n 15 "$cluster"/*.log "$shared"/balls.farm/*.log 2> /dev/null || true
}

stopCluster() {
  local process
  [[ -n $cluster ]] || return 0
  for process in $(processesOfCluster); do
    ((process == $$)) || kill -9 "$process" 2> /dev/null || true
  done
  for process in "${daemons[@]}"; do
    kill -9 "$process" 2> /dev/null || true
  done
  for ((process = 0; process < 100; ++process)); do
    [[ -n $(processesOfCluster) ]] || break
    sleep 0.1
  done
  rm -rf -- "$cluster"
}
