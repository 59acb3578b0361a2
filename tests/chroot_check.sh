#!/usr/bin/env bash
# Does the README's promise hold on a machine that has nothing? Makes a bare Debian 12 (debootstrap), clones this
# checkout into it, and runs ./run and ./test there as documented. A green run on a developer's machine hides a
# missing install step; here a package absent from packages.txt fails. Not part of the automatic tests: it takes a
# quarter of an hour and needs root. See usage below.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
source "$root/tools/setup.sh"

usage() {
  cat <<'USAGE'
usage: sudo tests/chroot_check.sh [--packages-only] [--run-only] [--package FILE] [--keep] [--folder DIR]

  --packages-only   stop after installing the packages and configuring: the quick half
  --package FILE    instead of all that: install this Debian package of ./run package there, and use the programs
  --run-only        ./run, without ./test
  --keep            leave the bare system for a look around (its path is printed)
  --folder DIR      where to make it (default: a new folder under $TMPDIR or /tmp; needs about 8 GB)
USAGE
}

packagesOnly=0 runOnly=0 keep=0 folder="" package=""
while (($# > 0)); do
  case $1 in
    --packages-only) packagesOnly=1 ;;
    --run-only) runOnly=1 ;;
    --package) package=$(realpath -e -- "${2:?--package needs a file}"); shift ;;
    --keep) keep=1 ;;
    --folder) folder=${2:?--folder needs a path}; shift ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; die "unknown option $1" ;;
  esac
  shift
done

((EUID == 0)) || die "making a bare system needs root: sudo tests/chroot_check.sh"
command -v debootstrap > /dev/null || die "debootstrap is missing: apt-get install debootstrap"
command -v git > /dev/null || die "git is missing: apt-get install git"

# In mount and process namespaces of its own, every mount and process below ends with this script, however it
# ends; removing the folder can then never reach into the machine's own /dev.
if [[ ${ACENTRIC_CHROOT_NAMESPACE-} != yes ]]; then
  if [[ -z $folder ]]; then folder=$(mktemp -d "${TMPDIR:-/tmp}/acentric-bare.XXXXXX"); else mkdir -p -- "$folder"; fi
  folder=$(realpath -- "$folder")
  [[ -z $(ls -A -- "$folder") ]] || die "$folder is not empty"
  options=(--folder "$folder")
  ((packagesOnly)) && options+=(--packages-only)
  ((runOnly)) && options+=(--run-only)
  ((keep)) && options+=(--keep)
  [[ -z $package ]] || options+=(--package "$package")
  status=0
  ACENTRIC_CHROOT_NAMESPACE=yes unshare --mount --pid --fork --kill-child --propagation private \
    bash "${BASH_SOURCE[0]}" "${options[@]}" || status=$?
  if ((keep)); then say "The bare system is kept in $folder"; else rm -rf --one-file-system -- "$folder"; fi
  exit "$status"
fi

# The machine's own mirrors for bookworm, with the settings by which it reaches them.
mapfile -t sources < <(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CODENAME) $(COMPONENT)' \
  'Created-By: Packages' | awk '$3 ~ /^bookworm/ { print "deb", $1, $2, $4 }' | sort -u)
mirror=$(printf '%s\n' "${sources[@]}" | awk '$3 == "bookworm" && $4 == "main" { print $2; exit }')
[[ -n $mirror ]] || die "this machine's apt knows no mirror for Debian 12 (bookworm)"

system=$folder/system
began=$SECONDS
say "== A bare Debian 12"
debootstrap --variant=minbase --include=ca-certificates bookworm "$system" "$mirror" > "$folder/debootstrap.log" 2>&1 ||
  { tail -20 "$folder/debootstrap.log" >&2; die "debootstrap failed"; }
printf '%s\n' "${sources[@]}" > "$system/etc/apt/sources.list"
apt-config dump | grep -E '^Acquire::(http|https|ftp)::[Pp]roxy' > "$system/etc/apt/apt.conf.d/99proxy" || true
cp /etc/resolv.conf "$system/etc/resolv.conf"
mount -t proc proc "$system/proc"
mount -t sysfs -o ro sysfs "$system/sys"
mount --rbind /dev "$system/dev"
mount -t tmpfs tmpfs "$system/dev/shm"
say "   $((SECONDS - began)) s, $(du -shx "$system" | cut -f1)"

mkdir -p "$system/home/acentric"
# inside COMMAND: as a first user would run it, with a clean environment and no display.
inside() {
  env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    chroot "$system" /bin/bash -c "cd /home/acentric && $1" < /dev/null
}

# stage NAME COMMAND: one documented step, with its time.
stage() {
  local start=$SECONDS
  say "== $1"
  inside "$2" || die "$1 failed on a bare Debian 12 (above is why)"
  say "   $1: $((SECONDS - start)) s"
}

if [[ -n $package ]]; then
  cp -- "$package" "$system/home/acentric/acentric.deb"
  stage "installing the package" \
    'export DEBIAN_FRONTEND=noninteractive; apt-get -q update && apt-get -q install -y --no-install-recommends ./acentric.deb'
  stage "a walk by the command line" \
    'set -e; cp -r /usr/share/acentric/sample . && mkdir own && cd own
     acentric new ../sample/gallery.glb -o gallery.acentric.json --samples-per-degree 1 --config a --cell 2 \
       --outline "-4,-2;-2,-2;-2,0;-4,0" --no-estimate
     acentric bake gallery.acentric.json
     acentric render gallery.acentric.json -o ../view.png --size 480x270
     acentric export gallery.acentric.json page --to web'
  [[ -s $system/home/acentric/view.png ]] || die "there is no view.png"
  # On a screen of its own, whose picture lies in a file: nothing but the X server is added.
  stage "the editor, from the menu" \
    'set -e; export DEBIAN_FRONTEND=noninteractive; apt-get -q install -y --no-install-recommends xvfb > /dev/null
     Xvfb :7 -screen 0 1600x900x24 -fbdir /home/acentric & sleep 3
     export DISPLAY=:7; $(sed -n "s/^Exec=\([^ ]*\).*/\1/p" /usr/share/applications/acentric-editor.desktop) \
       --log-ui /home/acentric/ui.log --size 1600x900 --exit-after 600 & editor=$!
     for ((i = 0; i < 300; ++i)); do grep -qs "event walkpreview" ui.log && break; sleep 1; done
     grep -q "event walkpreview" ui.log; sleep 1; cp Xvfb_screen0 screen.xwd; kill -INT $editor; wait $editor'
  [[ -f $system/root/.local/share/acentric/gallery/gallery.acentric.json ]] || die "the editor made no copy of the sample"
  say "== The package works on a bare Debian 12: $system/home/acentric has view.png and screen.xwd (--keep)."
  exit 0
fi

say "== The checkout"
git -C "$root" diff --quiet HEAD || say "   note: uncommitted changes are not in the clone"
git clone --quiet --no-hardlinks "$root" "$system/home/acentric"
if ((packagesOnly)); then
  stage "packages and configuring" \
    'set -euo pipefail; root=$PWD; source tools/setup.sh; ensurePackages build run; configure release OFF;
     ensurePackages build run python test; configure release ON'
  exit 0
fi
stage "./run" "./run"
[[ -s $system/home/acentric/out/gallery/walk/contact_sheet.png ]] || die "./run left no contact sheet"
stage "./run again" "./run"
((runOnly)) || stage "./test" "./test"
say "== All of it works on a bare Debian 12."
