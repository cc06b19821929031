# Roots of other Debian suites, for scripts/test --on SUITE and scripts/package --on SUITE. Source it.

# debian_root SUITE PACKAGE...: makes a root with these packages, unless it is there; sets $root to its path.
debian_root() {
  local suite=$1 packages sudo=()
  shift
  packages=$(printf '%s\n' "$@" | sort -u | paste -sd,)
  root=${MOCHA_ROOTS:-$HOME/.cache/mocha_ugv}/$suite
  if ((EUID != 0)); then sudo=(sudo); fi
  [[ "$("${sudo[@]}" cat "$root/packages" 2>/dev/null)" != "$packages" ]] || return 0
  command -v mmdebstrap >/dev/null || { echo "mmdebstrap is missing: apt-get install mmdebstrap" >&2; return 1; }
  echo "making a root of Debian $suite in $root"
  mkdir -p "$(dirname "$root")"
  "${sudo[@]}" rm -rf "$root.new"
  "${sudo[@]}" mmdebstrap --quiet --aptopt='APT::Install-Recommends "false"' --include="$packages" "$suite" "$root.new"
  "${sudo[@]}" tee "$root.new/packages" <<<"$packages" >/dev/null
  # Only what this has made is replaced.
  if "${sudo[@]}" test -f "$root/packages"; then "${sudo[@]}" rm -rf "$root"; fi
  "${sudo[@]}" mv -T "$root.new" "$root"
}

# in_debian_root DIRECTORY COMMAND...: runs a command in $root, where DIRECTORY is /mocha_ugv and the working directory.
in_debian_root() {
  local sudo=()
  if ((EUID != 0)); then sudo=(sudo); fi
  "${sudo[@]}" unshare --mount --pid --fork --propagation private bash -ec '
    root=$1 directory=$2 data=$3
    shift 3
    mkdir -p "$root/mocha_ugv" "$root/shared/data"
    mount --bind "$directory" "$root/mocha_ugv"
    if [[ -d $data ]]; then mount --bind "$data" "$root/shared/data"; fi
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    cp /etc/resolv.conf /etc/hosts "$root/etc/"
    exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin MOCHA_DATA=/shared/data \
      bash -c "cd /mocha_ugv && exec \"\$@\"" - "$@"
  ' - "$root" "$1" "$(realpath -m "${MOCHA_DATA:-$1/../shared/data}")" "${@:2}"
}
