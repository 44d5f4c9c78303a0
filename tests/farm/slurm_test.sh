#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A crowd on a Slurm of its own, two nodes on the loopback interface. Meanwhile planning is interrupted, a
# task is killed, a node's daemon dies, a time limit strikes, the controller is restarted and the disk of
# one shard is full. The crowd equals that of one machine, byte for byte. Skipped (77) where Slurm is not
# and cannot be installed. All it starts it ends, by process id.
#   slurm_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
export PATH=$PATH:/usr/sbin:/sbin
"$root/scripts/install_dependencies.sh" --farm || { echo "SKIPPED: no Slurm here"; exit 77; }
getent hosts "$(hostname -s)" | grep -q '^127\.' || { echo "SKIPPED: $(hostname -s) is not 127.0.0.1"; exit 77; }
source "$root/tests/farm/private_slurm.sh"

work=$(mktemp -d) mounted= watching=
chmod 755 "$work"
finish() {
  local code=$?
  [ -z "$watching" ] || kill "$watching" 2>/dev/null || true
  slurm_stop "$work/slurm" || true
  if [ $code -ne 0 ]; then
    for log in "$work"/disk/crowd/submit/log/*.log; do echo "--- $log"; tail -n 15 "$log"; done
    tail -n 15 "$work/slurm/log/ctld.log"
  fi 2>/dev/null
  [ -z "$mounted" ] || umount "$work/disk" || umount -l "$work/disk" || true
  rm -rf "$work"
  exit $code
}
trap finish EXIT
fail() {
  echo "FAILED: $1"
  exit 1
}
# until_true SECONDS WHAT COMMAND …
until_true() {
  local seconds=$1 what=$2 end=$((SECONDS + $1))
  shift 2
  until "$@"; do
    [ $SECONDS -lt $end ] || fail "$what: not within $seconds s"
    sleep 0.3
  done
}

"$program" synth -q -o "$work/heads" --count 5 --vertices 5000 --seed 3
cat >"$work/crowd.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 21}
faces: {directory: heads, units: cm}
families: [{name: smith, members: 3, target: synth_03, max_distance: 4 mm}]
output: {directory: one/crowd, meshes: [obj, points], contact_sheet: {cell: 320, views: [front, profile]}}
YAML
"$program" generate -q "$work/crowd.yaml" --cache "$work/cache"

# The crowd's disk is small, so that it can be full.
mkdir "$work/disk"
if mount -t tmpfs -o size=64m,mode=755 none "$work/disk" 2>/dev/null; then
  mounted=yes
else
  echo "no file system can be mounted here: the disk of no shard will be full"
fi

# What the tasks run. Each disturbance comes once, in the first attempt.
mkdir "$work/once"
cat >"$work/disturbed" <<SH
#!/usr/bin/env bash
once() { mkdir "$work/once/\$1" 2>/dev/null; }
ledger=$work/disk/crowd/ledger-
has_faces() { until grep -q faces/ "\$ledger\${1}of4.jsonl" 2>/dev/null; do sleep 0.1; done; }
# Slurm may start the next attempt before status has shown how this one ended.
is_shown() { for _ in \$(seq 100); do ! grep -q "\$1" "$work/watched" || return 0; sleep 0.1; done; }
case " \$* " in
  *" plan "*)
    if once plan; then "$program" "\$@" & kill -TERM \$!; wait \$!; exit 75; fi ;;
  *" --shard 1/4 "*generate* | *generate*" --shard 1/4 "*)
    if once killed; then
      "$program" "\$@" & child=\$!
      has_faces 1; kill -KILL \$child; wait \$child; exit 137
    fi ;;
  *generate*" --shard 2/4 "*)
    if once node; then
      "$program" "\$@" & child=\$!
      has_faces 2; kill -STOP \$child; echo "\$SLURMD_NODENAME" >"$work/node_of_2"
      # The node goes on when its daemon is dead; another may have taken the shard meanwhile.
      until [ -e "$work/go_on" ]; do sleep 0.1; done
      kill -CONT \$child; wait \$child; exit
    fi ;;
  *generate*" --shard 3/4 "*)
    if [ -n "$mounted" ] && once disk; then
      "$program" "\$@" & child=\$!
      has_faces 3; cat /dev/zero >"$work/disk/ballast" 2>/dev/null
      wait \$child; code=\$?; rm "$work/disk/ballast"; exit \$code
    fi ;;
  *generate*" --shard 4/4 "*)
    if once limit; then
      "$program" "\$@" & child=\$!
      trap 'kill -TERM \$child; kill -CONT \$child' TERM
      has_faces 4; kill -STOP \$child
      while kill -0 \$child 2>/dev/null; do wait \$child; code=\$?; done
      is_shown '"state":"interrupted"'; exit \$code
    fi ;;
esac
exec "$program" "\$@"
SH
chmod +x "$work/disturbed"

slurm_start "$work/slurm"
crowd=$work/disk/crowd
submit() {
  "$program" submit -q "$work/crowd.yaml" --out "$crowd" --shards 4 --prepare-tasks 2 --time 1 --grace 50 \
    --memory "1 GiB" --scratch "$work/\$SLURMD_NODENAME" --program "$work/disturbed"
}
submit
"$program" status "$crowd" --watch --json --every 1 >"$work/watched" &
watching=$!

until_true 90 "shard 2 begins" test -s "$work/node_of_2"
node=$(cat "$work/node_of_2")
kill -KILL "$(cat "$work/slurm/slurmd.$node.pid")"
until_true 60 "the node is down" sh -c "sinfo -h -N -n $node -o %T | grep -q down"
kill "$(cat "$work/slurm/ctld.pid")"
until_true 20 "the controller is gone" sh -c "! kill -0 $(cat "$work/slurm/ctld.pid") 2>/dev/null"
slurmctld -f "$SLURM_CONF"
slurm_node "$work/slurm" "$node"
touch "$work/go_on"
# A task that ends just when its node comes back makes Slurm drain that node; whoever runs it takes it back.
# A task that starts just then may be ended by Slurm ("Job credential revoked") before its script runs; the
# gathering says whose faces are missing, and the same submit command makes them.
is_gathered() {
  sinfo -h -N -o '%N %T' | awk '/drain/ {print $1}' | xargs -r -I{} scontrol update nodename={} state=resume || true
  if grep -q "run their shards again" "$crowd/submit/log/gather-1.log" 2>/dev/null && [ ! -e "$work/submitted_again" ]; then
    touch "$work/submitted_again"
    submit
  fi
  test -e "$crowd/report.json"
}
until_true 150 "the crowd is gathered" is_gathered
until_true 30 "no job is left" sh -c '[ -z "$(squeue -h)" ]'
"$program" status "$crowd" | grep -q "finished: 24 of 24" || fail "status does not say that it is finished"

diff -r --exclude=submit --exclude=crowdface.log --exclude=timings.json "$work/one/crowd" "$crowd" ||
  fail "the crowd is not that of one machine"
"$program" verify -q "$crowd"

# All of it did happen.
log=$crowd/submit/log
said() { grep -q "$2" "$log/$1.log" || fail "$1.log does not say: $2"; }
said plan-1 "attempt 2"
said blend-1 "ended with code 137"
said blend-4 "ended with code 75"
for shard in 1 4; do said blend-$shard "attempt 2"; done
[ "$(grep -c "=== blend 2, attempt" "$log/blend-2.log")" -ge 2 ] || fail "shard 2 was not begun again"
if [ -n "$mounted" ]; then
  said blend-3 "ended with code 7[34]"
  said blend-3 "No space left"
  said blend-3 "attempt 2"
fi
ls "$work"/n?/crowdface-cache-*/prepared-*.cfcache >/dev/null || fail "no node has a copy of the prepared heads"
grep -q '"state":"interrupted"' "$work/watched" || fail "status never showed an interrupted shard"
# Slurm queues a failed shard again, within the second between two looks.
grep -Eq '"state":"(failed|requeued)"[^}]*"reason":"[^"]' "$work/watched" || fail "status never showed a reason"
grep -q '"faces_a_second":[0-9]' "$work/watched" || fail "status never showed a pace"
echo "the crowd of two nodes is that of one machine"
