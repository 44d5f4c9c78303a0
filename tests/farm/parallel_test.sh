#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A crowd by GNU parallel over ssh: a server of its own on a port of the loopback interface, with keys of
# its own. One task is killed and runs again. The crowd equals that of one machine, byte for byte. Skipped
# (77) where parallel and sshd are not and cannot be installed. All it starts it ends, by process id.
#   parallel_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
export PATH=$PATH:/usr/sbin:/sbin
"$root/scripts/install_dependencies.sh" --farm || { echo "SKIPPED: no GNU parallel or sshd here"; exit 77; }
source "$root/tests/farm/private_slurm.sh"  # free_ports

work=$(mktemp -d)
chmod 755 "$work"
finish() {
  local code=$?
  [ ! -f "$work/ssh/pid" ] || kill "$(cat "$work/ssh/pid")" 2>/dev/null || true
  [ $code -eq 0 ] || tail -n 15 "$work"/crowds/two/submit/log/*.log "$work/ssh/log" 2>/dev/null || true
  rm -rf "$work"
  exit $code
}
trap finish EXIT

mkdir -m 700 "$work/ssh"
port=$(free_ports)
ssh-keygen -q -t ed25519 -N '' -f "$work/ssh/host"
ssh-keygen -q -t ed25519 -N '' -f "$work/ssh/user"
cp "$work/ssh/user.pub" "$work/ssh/authorized"
cat >"$work/ssh/sshd_config" <<CONF
ListenAddress 127.0.0.1
Port $port
HostKey $work/ssh/host
PidFile $work/ssh/pid
AuthorizedKeysFile $work/ssh/authorized
PasswordAuthentication no
PermitRootLogin prohibit-password
StrictModes no
UsePAM no
MaxStartups 100
CONF
[ "$(id -u)" -ne 0 ] || mkdir -p -m 755 /run/sshd
"$(command -v sshd)" -f "$work/ssh/sshd_config" -E "$work/ssh/log"
export PARALLEL_HOME=$work/parallel
mkdir "$PARALLEL_HOME"
export PARALLEL_SSH="ssh -p $port -i $work/ssh/user -o BatchMode=yes -o StrictHostKeyChecking=no -o UserKnownHostsFile=$work/ssh/known -o LogLevel=ERROR"
for _ in $(seq 50); do
  $PARALLEL_SSH 127.0.0.1 true 2>/dev/null && break
  sleep 0.2
done
$PARALLEL_SSH 127.0.0.1 true || { echo "SKIPPED: sshd does not let us in here"; tail "$work/ssh/log"; exit 77; }

"$program" synth -q -o "$work/heads" --count 4 --vertices 5000 --seed 3
cat >"$work/crowd.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 9}
faces: {directory: heads, units: cm}
output: {directory: crowds/one, meshes: [obj], contact_sheet: {cell: 96}}
YAML
"$program" generate -q "$work/crowd.yaml" --cache "$work/cache"

# Its path has what a shell would take apart.
mkdir "$work/it's odd"
cat >"$work/it's odd/program" <<SH
#!/usr/bin/env bash
case " \$* " in *generate*" --shard 2/3 "*) mkdir "$work/once" 2>/dev/null && kill -KILL \$\$ ;; esac
[ -n "\$SSH_CONNECTION" ] && case " \$* " in *generate*) echo over ssh >>"$work/ways" ;; esac
exec "$program" "\$@"
SH
chmod +x "$work/it's odd/program"
"$program" submit -q "$work/crowd.yaml" --out "$work/crowds/two" --engine parallel --shards 3 \
  --prepare-tasks 2 --host 127.0.0.1 --program "$work/it's odd/program"
diff -r --exclude=submit --exclude=crowdface.log --exclude=timings.json "$work/crowds/one" "$work/crowds/two"
[ "$(grep -c 'over ssh' "$work/ways")" -eq 3 ] || { echo "not all shards came over ssh"; exit 1; }
grep -q "ended with code 137" "$work/crowds/two/submit/log/blend-2.log"
# What fails at one task's hands has its code.
code=0
"$program" submit -q "$work/crowd.yaml" --out "$work/crowds/three" --engine parallel --shards 2 \
  --set diversity.min_distance=900mm >"$work/said" 2>&1 || code=$?
[ $code -eq 3 ] || { cat "$work/said"; echo "expected code 3, found $code"; exit 1; }
echo "the crowd of parallel's tasks is that of one machine"
