#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs a package of this project into an empty root and runs it there: packaging/try.sh PACKAGE.deb
# Packages for another processor are only unpacked, and run under qemu-user.
set -euo pipefail
package="$(realpath "$1")"
architecture="$(dpkg-deb -f "$package" Architecture)"
root="$(mktemp -d)"
trap 'rm -rf "$root"' EXIT
die() { printf 'package: %s\n' "$*" >&2; exit 1; }

files="$(dpkg-deb --fsys-tarfile "$package" | tar -t)"
for file in ./usr/bin/disflow_track ./etc/disflow/track.toml ./lib/systemd/system/disflow-track.service \
  ./usr/include/disflow/tracker.h ./usr/lib/cmake/disflow/disflow-config.cmake ./usr/share/doc/disflow/deploy.md ./usr/share/doc/disflow/disflow.cdx.json \
  ./usr/include/disflow.h ./usr/share/pkgconfig/disflow.pc ./usr/share/man/man1/disflow_track.1.gz \
  ./usr/share/bash-completion/completions/disflow_track; do
  grep -qx "$file" <<<"$files" || die "$file is missing in $package"
done
[[ "$(dpkg-deb -f "$package" Depends)" == *libc6* ]] || die "$package has no dependencies"

lintian --allow-root --fail-on error,warning "$package" || die "lintian finds faults in $package"

# What the package for each processor must have; docs/deploy.md says what the ARM presets leave out and why.
features() {
  case "$architecture" in
    arm64) echo "v4l2 libcamera serial udp mavlink" ;;
    armhf) echo "v4l2 serial udp mavlink" ;;
    *) echo "v4l2 libcamera serial udp mavlink dds rosbag view" ;;
  esac
}

# try_track COMMAND...: asks what it was built with, tracks a simulated object, and tries the settings as installed.
try_track() {
  local version
  version="$("$@" --version)" || die "does not start"
  echo "$version"
  [ "$(sed -n 's/^with: //p' <<<"$version")" = "$(features)" ] || die "built with something else than: $(features)"
  "$@" --sensor 'sim:box?frames=30&motion=fast' --headless 2>&1 | grep '30 with a measured pose' || die "does not track"
  local status=0
  "$@" --config "$config" 2>/dev/null || status=$?
  [ $status -eq 2 ] || die "the settings as installed end with $status, 2 (no sensor) was expected"
}

if [ "$architecture" = "$(dpkg --print-architecture)" ] && [ "$(id -u)" -eq 0 ] && command -v mmdebstrap >/dev/null; then
  suite="$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)"
  # What the package says it needs, and nothing else.
  needed="$(dpkg-deb -f "$package" Depends | tr ',' '\n' | awk '{print $1}' | paste -s -d ,)"
  mmdebstrap --quiet --variant=essential --include="$needed" "$suite" "$root/clean" >/dev/null 2>"$root/log" || {
    tail -n 20 "$root/log" >&2
    die "no empty $suite root could be made"
  }
  cp "$package" "$root/clean/tmp/disflow.deb"
  chroot "$root/clean" dpkg --install /tmp/disflow.deb >/dev/null || die "it cannot be installed into an empty $suite"
  config=/etc/disflow/track.toml
  try_track chroot "$root/clean" /usr/bin/disflow_track
  chroot "$root/clean" dpkg --remove disflow >/dev/null
  [ ! -e "$root/clean/usr/bin/disflow_track" ] || die "it leaves programs behind when it is removed"
  [ -e "$root/clean/etc/disflow/track.toml" ] || die "removing it takes the settings away"
  echo "$(basename "$package"): installed, run and removed in an empty $suite root"
else
  dpkg-deb -x "$package" "$root/tree"
  config="$root/tree/etc/disflow/track.toml"
  case "$architecture" in
    arm64) try_track qemu-aarch64 "$root/tree/usr/bin/disflow_track" ;;
    armhf) try_track qemu-arm -L "${DISFLOW_ARMHF_ROOT:-/}" "$root/tree/usr/bin/disflow_track" ;;
    *) try_track "$root/tree/usr/bin/disflow_track" ;;
  esac
  echo "$(basename "$package"): unpacked and run"
fi
