# The set-up that ./run, ./test and tests/chroot_check.sh share: packages, configuring, building.
# Sourced with `root` set to the folder of the sources. Speaks on stderr, so that stdout stays the command's own.

say() { printf '%s\n' "$*" >&2; }
die() { say "error: $*"; exit 1; }

# packagesOf GROUP...: the package names of these groups of packages.txt, one a line.
packagesOf() {
  local wanted=" $* " group="" line
  while IFS= read -r line || [[ -n $line ]]; do
    line=${line%%#*}
    line=${line//[[:space:]]/}
    case $line in
      "") ;;
      "["*"]") group=${line#[}; group=${group%]} ;;
      *) if [[ $wanted == *" $group "* ]]; then printf '%s\n' "$line"; fi ;;
    esac
  done < "$root/packages.txt"
}

# missingPackages NAME...: those that are neither installed nor provided by a package that is (as npm is by some
# builds of nodejs), one a line. One dpkg-query for all, so it is quick.
missingPackages() {
  local there
  there=$(dpkg-query --show --showformat='${db:Status-Status}|${Package}, ${Provides}\n' |
    sed -n -E 's/^installed\|//p' | tr ',' '\n' | sed -E 's/^ +//; s/[ :(].*//')
  comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<< "$there")
}

# ensurePackages GROUP...: installs what is missing from these groups, and nothing where nothing is.
ensurePackages() {
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    die "this set-up knows Debian's packages only, and there is no apt-get here. Install the like of packages.txt" \
        "by hand, then build with: cmake --preset release && cmake --build --preset release"
  fi
  local names missing
  mapfile -t names < <(packagesOf "$@")
  ((${#names[@]} > 0)) || die "packages.txt names nothing for: $*"
  mapfile -t missing < <(missingPackages "${names[@]}")
  ((${#missing[@]} > 0)) || return 0

  say "Acentric needs ${#missing[@]} Debian packages that are not installed yet (groups of packages.txt: $*):"
  printf '%s\n' "${missing[*]}" | fold -s -w 100 | sed 's/^/  /' >&2
  local asRoot=()
  if ((EUID != 0)); then
    command -v sudo > /dev/null || die "installing them needs root, and there is no sudo. As root, run:" \
      "apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    say "They are installed with apt-get through sudo, which may ask for your password."
    asRoot=(sudo)
  else
    say "They are installed now with apt-get."
  fi
  # Never a question from a package, and never our caller's input read by one.
  asRoot+=(env DEBIAN_FRONTEND=noninteractive)
  local apt=(apt-get -q -o Dpkg::Use-Pty=0 -o Acquire::Retries=3)
  "${asRoot[@]}" "${apt[@]}" update < /dev/null >&2 ||
    die "apt-get update failed (above is why): check the network and /etc/apt/sources.list, then try again."
  "${asRoot[@]}" "${apt[@]}" install -y --no-install-recommends "${missing[@]}" < /dev/null >&2 ||
    die "apt-get could not install them (above is why). Acentric is made for Debian 12 (bookworm)."
}

# buildJobs: one for each processor, but no more than the free memory carries: the largest sources take about
# 1.5 GB to compile, and a machine that swaps is slower than one job less.
buildJobs() {
  local processors available byMemory
  processors=$(nproc)
  available=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)
  byMemory=$((${available:-1500} / 1500))
  ((byMemory >= 1)) || byMemory=1
  echo $((processors < byMemory ? processors : byMemory))
}

# configure PRESET ON|OFF: once; afterwards ninja configures by itself whenever a build file changed.
# ON adds the tests to a folder configured without them. OFF never takes them away.
configure() {
  local preset=$1 tests=$2 folder=$root/build/$1
  if [[ -f $folder/build.ninja ]]; then
    if [[ $tests == OFF ]] || grep -q '^ACENTRIC_TESTS:BOOL=ON' "$folder/CMakeCache.txt"; then return 0; fi
  fi
  say "Configuring (preset $preset)."
  local log status=0
  log=$(mktemp)
  (cd "$root" && cmake --preset "$preset" -DACENTRIC_TESTS="$tests") < /dev/null > "$log" 2>&1 || status=$?
  if ((status != 0)); then
    cat "$log" >&2
    rm -f "$log"
    die "CMake could not configure (above is why). If packages changed, remove $folder and try again."
  fi
  rm -f "$log"
}

# build PRESET TARGET...: quiet when there is nothing to do.
build() {
  local preset=$1 jobs
  shift
  jobs=$(buildJobs)
  [[ -d $root/build/$preset/bin ]] || say "Building with $jobs jobs; the first time takes minutes."
  (cd "$root" && cmake --build --preset "$preset" -j "$jobs" --target "$@") < /dev/null >&2 ||
    die "the build failed (the first error above is why)."
}

# buildWebModule: what the page has of the engine, build/page/page.wasm. Quiet when there is nothing to do.
buildWebModule() {
  local source=$root/web/runtime folder=$root/build/page log status=0
  log=$(mktemp)
  if [[ ! -f $folder/build.ninja ]]; then
    cmake -S "$source" -B "$folder" -G Ninja --toolchain "$source/toolchain.cmake" < /dev/null > "$log" 2>&1 || status=$?
  fi
  ((status != 0)) || cmake --build "$folder" -j "$(buildJobs)" < /dev/null >> "$log" 2>&1 || status=$?
  if ((status != 0)); then
    cat "$log" >&2
    rm -f "$log"
    die "the page's module could not be built (above is why)."
  fi
  rm -f "$log"
}

# buildWeb: the page of `acentric export --to web` and the package for three.js, with the packages of the page's lock file. Quiet
# when there is nothing to do.
buildWeb() {
  local web=$root/web newer
  buildWebModule
  if [[ ! -f $web/node_modules/.package-lock.json || $web/package-lock.json -nt $web/node_modules/.package-lock.json ]]; then
    say "Installing the page's packages (npm ci)."
    (cd "$web" && npm ci --no-audit --no-fund) < /dev/null >&2 ||
      die "npm ci failed (above is why): check the network, then try again."
    touch "$web/node_modules/.package-lock.json"
  fi
  newer=$web/dist/index.html # which comes last
  if [[ -f $newer && -z $(find "$web/src" "$web"/*.* "$web/three/src" "$web/three"/*.* "$root/shaders" "$root/build/page/page.wasm" -newer "$newer" -type f -print -quit) ]]; then return 0; fi
  say "Building the page."
  (cd "$web" && npm run --silent build) < /dev/null >&2 || die "the page could not be built (above is why)."
}
