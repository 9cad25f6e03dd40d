# shellcheck shell=bash
# Functions that install and use a fresh Debian in a folder. A script sources this file after options.sh.
# Needs root, mmdebstrap, and Debian's mirror.

# make_debian RELEASE FOLDER [OPTION...]: installs a release, such as trixie, with options for mmdebstrap.
make_debian() {
  ((EUID == 0)) || refuse "needs root"
  command -v mmdebstrap >/dev/null || refuse "found no mmdebstrap, expected Debian's package"
  mmdebstrap --quiet --variant=minbase --include=mount "${@:3}" "$1" "$2"
}

# in_debian FOLDER [VARIABLE=VALUE...] COMMAND...: runs a command as root in the Debian in FOLDER, with /proc,
# /sys and /dev. Only the command sees these mounts, and they end with the command.
in_debian() {
  # shellcheck disable=SC2016  # the inner shell expands the variables
  unshare --mount sh -ec '
    mount --bind "$0" "$0"
    cd "$0"
    for each in proc sys dev; do mount --rbind "/$each" "$each"; done
    pivot_root . mnt
    umount -l /mnt
    exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"' "$@"
}
