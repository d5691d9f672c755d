#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages of this project into an empty root and uses them there: packaging/try.sh FOLDER
# Packages for another processor are only unpacked, and run under qemu-user with the libraries that they say they need.
set -euo pipefail
folder="$(realpath "$1")"
tree="$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
die() { printf 'package: %s\n' "$*" >&2; exit 1; }
package_of() { echo "$folder/$1"_*.deb; }
programs="$(package_of disflow)"
architecture="$(dpkg-deb -f "$programs" Architecture)"
multiarch="$(dpkg-architecture -a "$architecture" -q DEB_HOST_MULTIARCH 2>/dev/null)"
native=
[ "$architecture" != "$(dpkg --print-architecture)" ] || native=yes

# has PACKAGE FILE...: what it must hold.
has() {
  local package files file
  package="$(package_of "$1")"
  shift
  files="$(dpkg-deb --fsys-tarfile "$package" | tar -t)"
  for file in "$@"; do
    grep -qx "./$file" <<<"$files" || die "$file is missing in $package"
  done
}
has disflow usr/bin/disflow_track etc/disflow/track.toml lib/systemd/system/disflow-track.service usr/share/doc/disflow/disflow.cdx.json \
  usr/share/man/man1/disflow_track.1.gz usr/share/bash-completion/completions/disflow_track
has libdisflow0.1 "usr/lib/$multiarch/libdisflow.so.0.1"
has libdisflow-dev usr/include/disflow/tracker.h usr/include/disflow.h "usr/lib/$multiarch/libdisflow.so" "usr/lib/$multiarch/libdisflow_core.a" \
  "usr/lib/$multiarch/cmake/disflow/disflow-config.cmake" "usr/lib/$multiarch/pkgconfig/disflow.pc"
has disflow-doc usr/share/doc/disflow/docs/deploy.md usr/share/doc/disflow/docs/images/live-view.png usr/share/doc/disflow/docs/tutorials/cpp.md
[ -z "$native" ] || has python3-disflow usr/lib/python3/dist-packages/disflow/__init__.py
[[ "$(dpkg-deb -f "$programs" Depends)" == *libc6* ]] || die "$programs has no dependencies"

# file_of PACKAGE FILE: what it holds.
file_of() { dpkg-deb --fsys-tarfile "$(package_of "$1")" | tar -xO "./$2"; }
# Each package carries the licences of all that was compiled into the programs, by their own bill of materials.
compiled_in="$(file_of disflow usr/share/doc/disflow/disflow.cdx.json | python3 -c '
import json, sys
for item in json.load(sys.stdin)["components"]:
    if all(use["value"] != "linked" for use in item["properties"]):
        print(item["name"])')"
[ -z "$native" ] || grep -qx pybind11 <<<"$compiled_in" || die "the bill of materials does not name pybind11"
[ -n "$compiled_in" ] || die "the bill of materials names nothing that is compiled in"
for package in disflow libdisflow0.1 libdisflow-dev disflow-doc ${native:+python3-disflow}; do
  copyright="$(file_of "$package" "usr/share/doc/$package/copyright")" || die "$package has no copyright"
  while IFS= read -r name; do
    grep -qF "Comment: $name: " <<<"$copyright" || die "$name is compiled in, but $package's copyright does not name it"
  done <<<"$compiled_in"
done

# Who reads the pages has no tree beside them.
dpkg-deb -x "$(package_of disflow-doc)" "$work/pages"
python3 -B "$tree/tests/docs/installed_links.py" "$work/pages/usr/share/doc/disflow" || die "pages lead to what is not in their package"

lintian --allow-root --fail-on error,warning "$folder"/*.deb || die "lintian finds faults"

# The shared library names itself as its package does, and needs nothing but C's library.
dpkg-deb -x "$(package_of libdisflow0.1)" "$work/library"
dynamic="$(readelf -d "$work/library/usr/lib/$multiarch/libdisflow.so.0.1")"
grep -q 'SONAME.*\[libdisflow.so.0.1\]' <<<"$dynamic" || die "the SONAME is not libdisflow.so.0.1: $dynamic"
! grep NEEDED <<<"$dynamic" | grep -vE '\[(libc\.so\.6|libm\.so\.6|libgcc_s\.so\.1|ld-linux[^]]*)\]' || die "the library needs more than C's"

# What the package for every processor must have.
features="v4l2 libcamera serial udp mavlink dds rosbag view"
suite="$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)"

# needed PACKAGE...: what they say they need, without versions and without each other.
needed() {
  local package
  for package in "$@"; do
    dpkg-deb -f "$package" Depends | tr ',' '\n' | awk 'NF && $1 !~ /^libdisflow/ {print $1}'
  done | sort -u | paste -s -d ,
}

# try_track COMMAND...: asks what it was built with, tracks a simulated object, and tries the settings as installed.
try_track() {
  local version
  version="$("$@" --version)" || die "does not start"
  echo "$version"
  [ "$(sed -n 's/^with: //p' <<<"$version")" = "$features" ] || die "built with something else than: $features"
  "$@" --sensor 'sim:box?frames=30&motion=fast' --headless 2>&1 | grep '30 with a measured pose' || die "does not track"
  local status=0
  "$@" --config "$config" 2>/dev/null || status=$?
  [ $status -eq 2 ] || die "the settings as installed end with $status, 2 (no sensor) was expected"
}

# try_library: a C program, compiled by what pkg-config says of the installed package, runs with the shared library.
try_library() {
  local root="$1" flags
  flags="$(PKG_CONFIG_LIBDIR="$root/usr/lib/$multiarch/pkgconfig" pkg-config --cflags --libs disflow)" || die "pkg-config does not find disflow"
  # shellcheck disable=SC2086  # several flags
  gcc -std=c99 -O2 "$tree/docs/examples/track.c" $flags -o "$root/tmp/track" || die "a C program cannot be compiled"
  readelf -d "$root/tmp/track" | grep -q 'NEEDED.*libdisflow.so.0.1' || die "the C program does not use the shared library"
  chroot "$root" /tmp/track | grep 'surface: ok' || die "the C program does not track"
}

# The Python module, with Debian's numpy.
try_python() {
  chroot "$1" /usr/bin/python3 -c '
import disflow, numpy
tracker = disflow.Tracker()
print("python:", disflow.__version__, type(tracker).__name__)' || die "the Python module does not start"
}

if [ -n "$native" ] && [ "$(id -u)" -eq 0 ] && command -v mmdebstrap >/dev/null; then
  root="$work/clean"
  # What the packages say they need, and nothing else.
  mmdebstrap --quiet --variant=essential --include="$(needed "$folder"/*.deb)" "$suite" "$root" >/dev/null 2>"$work/log" || {
    tail -n 20 "$work/log" >&2
    die "no empty $suite root could be made"
  }
  cp "$folder"/*.deb "$root/tmp/"
  chroot "$root" sh -c 'dpkg --install /tmp/*.deb' >/dev/null || die "they cannot be installed into an empty $suite"
  config=/etc/disflow/track.toml
  try_track chroot "$root" /usr/bin/disflow_track
  try_library "$root"
  try_python "$root"
  chroot "$root" dpkg --remove disflow python3-disflow libdisflow-dev libdisflow0.1 disflow-doc >/dev/null
  [ ! -e "$root/usr/bin/disflow_track" ] || die "it leaves programs behind when it is removed"
  [ -e "$root/etc/disflow/track.toml" ] || die "removing it takes the settings away"
  installed=("$folder"/*.deb)
  echo "${installed[*]##*/}: installed, used and removed in an empty $suite root"
else
  dpkg-deb -x "$programs" "$work/tree"
  config="$work/tree/etc/disflow/track.toml"
  emulator=()
  case "$architecture" in
    arm64) emulator=(qemu-aarch64 -L "$work/needed") ;;
    armhf) emulator=(qemu-arm -L "$work/needed") ;;
  esac
  if [ ${#emulator[@]} -gt 0 ]; then
    IFS=, read -r -a libraries <<<"$(needed "$programs")"
    "$tree/toolchains/debian_root.sh" "$architecture" "$work/needed" "${libraries[@]}" >"$work/log" 2>&1 || {
      tail -n 20 "$work/log" >&2
      die "what $programs needs cannot be fetched"
    }
  fi
  try_track "${emulator[@]}" "$work/tree/usr/bin/disflow_track"
  echo "$(basename "$programs"): unpacked and run"
fi
