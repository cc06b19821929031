# Roots of Debian, made by mmdebstrap in $roots, for scripts/test --on and scripts/package. Source it. What is built in them lies there as well:
# in the checkout, roslaunch would find every launch file twice.
roots=${MOCHA_ROOTS:-$HOME/.cache/mocha_ugv}
as_root=()
if ((EUID != 0)); then as_root=(sudo); fi

# debian_root NAME SUITE PACKAGES [OPTION...]: makes a root with these packages, unless it is there; sets $root to its path. Options are
# mmdebstrap's.
debian_root() {
  local suite=$2 packages
  packages=$(printf '%s\n' $3 | sort -u | paste -sd,)
  root=$roots/$1
  [[ "$("${as_root[@]}" cat "$root/packages" 2>/dev/null)" != "$packages" ]] || return 0
  command -v mmdebstrap >/dev/null || { echo "mmdebstrap is missing: sudo apt-get install mmdebstrap" >&2; return 1; }
  echo "making a root of Debian $suite in $root"
  mkdir -p "$(dirname "$root")"
  "${as_root[@]}" rm -rf "$root.new"
  "${as_root[@]}" mmdebstrap --quiet --aptopt='APT::Install-Recommends "false"' ${packages:+--include="$packages"} "${@:4}" "$suite" "$root.new"
  "${as_root[@]}" tee "$root.new/packages" <<<"$packages" >/dev/null
  # Only what this has made is replaced.
  if "${as_root[@]}" test -f "$root/packages"; then "${as_root[@]}" rm -rf "$root"; fi
  "${as_root[@]}" mv -T "$root.new" "$root"
}

# What packages are built and tested with: setup lists the Qt of this machine's rviz only.
packages_for_all() { echo "$(scripts/setup --package --list) qtbase5-dev qt6-base-dev"; }

# arm64_sysroot SUITE: what is compiled against and linked for arm64; sets $root to its path. It lies outside the checkout, which rosrun and
# roslaunch search for nodes.
arm64_sysroot() {
  local packages link
  packages=$(scripts/setup --test --list | grep -vE 'librviz|^qt|pybind11|python3-dev' | grep -E -- '-dev$|^ros-.*-msgs$|^catkin$|^ros-message-generation$')
  debian_root "$1_arm64_sysroot" "$1" "$packages" --variant=extract --architectures=arm64
  # qemu would take these for the machine's.
  "${as_root[@]}" rm -rf "$root/dev" "$root/tmp"
  # From Debian 13 on, base-files makes this link, which nothing to link with needs.
  [[ -e $root/lib ]] || "${as_root[@]}" ln -s usr/lib "$root/lib"
  # Links to absolute paths lead out of it, and static libraries would be taken instead.
  while IFS= read -r link; do
    "${as_root[@]}" ln -sfr "$root$(readlink "$link")" "$link"
  done < <(find "$root" -type l -lname '/*')
}

# in_debian_root DIRECTORY:PLACE ... -- COMMAND...: runs a command in $root, where these directories are at these places. It begins in the first.
in_debian_root() {
  "${as_root[@]}" unshare --mount --pid --fork --propagation private bash -ec '
    root=$1 begin=${2#*:}
    shift
    mount --bind "$root" "$root"  # in it, namespaces can be made
    while [[ $1 != -- ]]; do
      mkdir -p "$root/${1#*:}"
      mount --bind "${1%%:*}" "$root/${1#*:}"
      shift
    done
    shift
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    cp /etc/resolv.conf /etc/hosts "$root/etc/"
    exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin \
      bash -c "cd $begin && exec \"\$@\"" - "$@"
  ' - "$root" "$@"
}

# Has the kernel run programs of arm64, by qemu.
emulate_arm64() {
  local formats=/proc/sys/fs/binfmt_misc
  [[ $(dpkg --print-architecture) != arm64 ]] || return 0
  [[ -e $formats/register ]] || "${as_root[@]}" mount -t binfmt_misc binfmt_misc $formats
  [[ -e $formats/qemu-aarch64 ]] || "${as_root[@]}" tee $formats/register </usr/lib/binfmt.d/qemu-aarch64.conf >/dev/null
}
