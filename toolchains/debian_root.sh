#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Debian's libraries for another processor, unpacked into a folder, for building, packaging and running under an emulator:
#   toolchains/debian_root.sh ARCHITECTURE FOLDER PACKAGE...
# Unpacked, because some cannot be installed beside this machine's own (libwebsockets-dev, libyaml-cpp-dev), and those
# that can want this machine's in the same version. dpkg's database is in the folder too, for what asks it about the packages:
# dpkg-shlibdeps and cmake/write_bom.cmake.
set -euo pipefail

# What mmdebstrap calls when it has unpacked the packages and still has them, in a name space where it owns all files.
if [ "${1:-}" = --finish ]; then # --finish FOLDER; DISFLOW_ROOT: where the folder will be, DISFLOW_ROOT_PACKAGES: what is asked for
  root="$2"
  # Links such as libz.so lead from the folder's / to this machine's.
  find "$root/usr/lib" -type l -lname '/*' -printf '%p %l\n' | while read -r link target; do
    ln -srf "$root$target" "$link"
  done
  # It is for one processor, so headers that differ from one to the other (dds/features.h) need no folder of their own, in
  # which a cross compiler would not look for them.
  for headers in "$root"/usr/include/*-linux-gnu*/; do
    if [ -d "$headers" ]; then cp -an "$headers." "$root/usr/include/"; fi
  done
  database="$root/var/lib/dpkg"
  control="$(mktemp -d)"
  trap 'rm -rf "$control"' EXIT
  echo 1 >"$database/info/format"
  for package in "$root"/var/cache/apt/archives/*.deb; do
    name="$(dpkg-deb -f "$package" Package)"
    [ "$(dpkg-deb -f "$package" Multi-Arch)" != same ] || name+=":$(dpkg-deb -f "$package" Architecture)"
    rm -rf "$control"
    dpkg-deb -e "$package" "$control"
    { sed '/^Package:/a Status: install ok installed' "$control/control" && echo; } >>"$database/status"
    for part in shlibs symbols; do
      if [ -e "$control/$part" ]; then cp "$control/$part" "$database/info/$name.$part"; fi
    done
    # dpkg-shlibdeps asks for the files where it finds them.
    dpkg-deb --fsys-tarfile "$package" | tar -t | sed -e 's,^\.,,' -e 's,/$,,' -e "s,^,$DISFLOW_ROOT," >"$database/info/$name.list"
  done
  # So that one can tell whether it has what is wanted.
  echo "$DISFLOW_ROOT_PACKAGES" >"$root/packages"
  exit 0
fi

architecture="$1"
folder="$(realpath -m "$2")"
shift 2
suite="$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)"
# shellcheck disable=SC2016  # apt fills it in
mapfile -t mirrors < <(apt-get indextargets --format '$(REPO_URI)' "Codename: $suite" 'Created-By: Packages')
[ ${#mirrors[@]} -gt 0 ] || {
  echo "apt knows no mirror of $suite to fetch packages from" >&2
  exit 1
}
rm -rf "$folder" "$folder.part"
mkdir -p "$folder.part"
export DISFLOW_ROOT="$folder" DISFLOW_ROOT_PACKAGES="$*" DISFLOW_ROOT_SCRIPT
DISFLOW_ROOT_SCRIPT="$(realpath "${BASH_SOURCE[0]}")"
# shellcheck disable=SC2016  # the hook's shell fills it in
mmdebstrap --quiet --architectures="$architecture" --variant=extract --include="$*" --format=tar \
  --extract-hook='"$DISFLOW_ROOT_SCRIPT" --finish "$1"' "$suite" - "deb ${mirrors[0]} $suite main" |
  tar -x --no-same-owner --exclude './dev/*' -C "$folder.part"
mv "$folder.part" "$folder"
