#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What a reader of README.md waits for: `./dev demo` in a Debian that has nothing but apt.
# usage: tests/fresh/demo.sh FOLDER      as root, from the root of the tree
set -euo pipefail

root="$1"
suite="$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)"

# Nobody else sees what is mounted here, and it goes with this process.
if [ -z "${DISFLOW_FRESH_MOUNTS:-}" ]; then
  DISFLOW_FRESH_MOUNTS=1 exec unshare --mount "$0" "$@"
fi

rm -rf --one-file-system "$root"
mkdir -p "$(dirname "$root")"
# The mirrors of this machine.
# shellcheck disable=SC2016  # apt fills it in
mapfile -t mirrors < <(apt-get indextargets --format '$(REPO_URI)' "Codename: $suite" 'Created-By: Packages')
mmdebstrap --quiet --variant=apt "$suite" "$root" "deb ${mirrors[0]} $suite main"
# How this machine reaches the network, and which certificates it believes.
mkdir -p "$root/etc/ssl/certs" "$root/root"
cp -rL /etc/ssl/certs/. "$root/etc/ssl/certs" 2>/dev/null || true
cp -L /etc/resolv.conf /etc/hosts "$root/etc"
if [ -d /etc/apt/apt.conf.d ]; then cp -rL /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d"; fi

# What git knows, as it is in the working tree.
mkdir "$root/disflow"
git ls-files -z | while IFS= read -r -d '' file; do
  [ ! -f "$file" ] || printf '%s\0' "$file"
done | tar --null --files-from=- -cf - | tar -C "$root/disflow" -xf -

mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"

# By the clock, and what the processors did: beside other work the first says little.
TIMEFORMAT='fresh: ./dev demo took %0R s; processors worked %0U + %0S s'
time chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
  ${NODE_EXTRA_CA_CERTS:+NODE_EXTRA_CA_CERTS="$NODE_EXTRA_CA_CERTS"} /disflow/dev demo
for file in summary.html bottle/mesh.png; do
  [ -s "$root/disflow/demo-output/$file" ] || { echo "demo-output/$file is not there" >&2; exit 1; }
done
umount --recursive "$root/dev"
umount "$root/proc"
rm -rf --one-file-system "$root"
echo "fresh: on $(nproc) processors; wanted are 240 s"
