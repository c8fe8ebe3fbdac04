#!/bin/sh
# Obtain TetGen 1.5.0 (AGPL-3+; predicates.cxx is public domain) from Debian's source
# package into third_party/tetgen. Needs apt-get, tar, gzip, sha256sum; not dpkg-dev.
# Leaves /etc/apt, apt's lists and apt's cache as they were. Idempotent.
set -eu
dest=${1:-$(cd "$(dirname "$0")/../.." && pwd)/third_party/tetgen}
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
tarball=tetgen_1.5.0.orig.tar.gz
tarball_sum=4d114861d5ef2063afd06ef38885ec46822e90e7b4ea38c864f76493451f9cf3
file_sums='c71ba56f6018d52cf5521d13b183e0356e935196ff9af560c585423aa519d234  tetgen.cxx
a5fb9b225bfd5c52e8a60e5144686922d3c76944f3014f2cb5d54a0f34a5ef7d  tetgen.h
fbd97e2c8103c85a7006c9fd47256e0bd944928da7df7f89bb512f0b32c12b5f  predicates.cxx
f15e3301d0f40116aa2e3567963c3dcc8dd45453337dedf592caa73a5390549f  LICENSE'
have() { (cd "$dest" 2>/dev/null && printf '%s\n' "$file_sums" | sha256sum -c --status); }
have && exit 0
if ! command -v apt-get >/dev/null || [ ! -f "$keyring" ]; then
  echo 'get-tetgen: no Debian system: set TETGEN_SOURCE_DIR to a folder with the source of TetGen 1.5.0' >&2
  exit 1
fi

echo "get-tetgen: fetching TetGen's source from Debian"
tmp=$(mktemp -d); trap 'rm -rf "$tmp"' EXIT
mkdir -p "$tmp/lists/partial" "$tmp/cache/archives/partial" "$tmp/dl"
# The mirror this machine already uses, from apt itself; else from its sources; else the default.
# shellcheck disable=SC2016 # $(REPO_URI) is for apt-get to expand
uri=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Codename: bookworm' 2>/dev/null | head -n 1)
[ -n "$uri" ] || uri=$(sed -n 's/^URIs:[[:space:]]*\([^[:space:]]*\/debian\/\{0,1\}\)\([[:space:]].*\)\{0,1\}$/\1/p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -n 1)
[ -n "$uri" ] || uri=http://deb.debian.org/debian
echo "deb-src [signed-by=$keyring] $uri bookworm main" >"$tmp/sources.list"
apt() { # the machine's own settings (proxy, certificates) stay in force; only these paths differ
  apt-get -qq -o Dir::Etc::SourceList="$tmp/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$tmp/lists" -o Dir::Cache="$tmp/cache" \
    -o APT::Sandbox::User="$(id -un)" -o Acquire::Retries=3 "$@"
}
apt update
(cd "$tmp/dl" && apt source --download-only --tar-only tetgen=1.5.0-5)
echo "$tarball_sum  $tmp/dl/$tarball" | sha256sum -c --quiet
mkdir -p "$dest"
# Debian's two patches change CMakeLists.txt and add a main(): no library code, so they are not needed.
tar -xzf "$tmp/dl/$tarball" -C "$dest" --strip-components=1 --no-same-owner \
  tetgen1.5.0/tetgen.cxx tetgen1.5.0/tetgen.h tetgen1.5.0/predicates.cxx tetgen1.5.0/LICENSE
have || { echo "get-tetgen: unpacked files do not match" >&2; exit 1; }
