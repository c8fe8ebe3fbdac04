#!/bin/sh
# Puts in place what the build needs and leaves alone what is already there: Debian's packages, TetGen's
# source and node_modules. `setup.sh test` adds what the tests and checks need.
set -eu
cd "$(dirname "$0")/../.."

fail() {
  echo "setup: $*" >&2
  exit 1
}

packages='g++ cmake ninja-build emscripten libglm-dev libgtest-dev nlohmann-json3-dev'
if [ "${1:-}" = test ]; then
  packages="$packages clang-format clang-tidy clang libclang-rt-14-dev"
  # Programs that open our files: about 120 MB to fetch. Tests skip those that are absent.
  packages="$packages gmsh calculix-ccx python3-meshio openfoam cgns-convert"
  [ -n "${CHROMIUM:-}" ] || packages="$packages chromium-headless-shell"
fi

# 1. Node and npm: the only things that have to be here already.
command -v npm >/dev/null || fail 'Node.js 20.19 or newer with npm is needed: see https://nodejs.org'
node -e 'const [a, b] = process.versions.node.split("."); process.exit(a > 20 || (a == 20 && b >= 19) ? 0 : 1)' ||
  fail "Node.js 20.19 or newer is needed, this is $(node --version): see https://nodejs.org"

# 2. Debian's packages.
if command -v dpkg-query >/dev/null; then
  missing=
  for package in $packages; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
  done
  if [ -n "$missing" ]; then
    if [ "$(id -u)" = 0 ]; then
      root=
    elif sudo -n true 2>/dev/null; then
      root='sudo -n'
    else
      fail "packages are missing. Run: sudo apt-get update && sudo apt-get install -y --no-install-recommends$missing"
    fi
    log=$(mktemp)
    trap 'rm -f "$log"' EXIT
    echo "setup: installing$missing"
    # shellcheck disable=SC2086 # $root and $missing are lists
    {
      $root env DEBIAN_FRONTEND=noninteractive apt-get update
      $root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
    } >"$log" 2>&1 </dev/null || {
      cat "$log" >&2
      fail 'apt-get could not install the packages'
    }
  fi
else
  echo "setup: no Debian system, so these have to be here already: $packages"
fi

# 3. TetGen's source; TETGEN_SOURCE_DIR names one that is here already.
if [ -z "${TETGEN_SOURCE_DIR:-}" ]; then
  core/toolchain/get-tetgen.sh
fi

# 4. npm's packages.
if [ ! -f node_modules/.package-lock.json ] || [ -n "$(find package-lock.json -newer node_modules/.package-lock.json)" ]; then
  echo 'setup: installing node_modules'
  npm ci --include=dev --no-fund --no-audit --loglevel=error
fi
