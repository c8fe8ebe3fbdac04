#!/bin/sh
# Formatting and static checks of everything, changing nothing. `npm run format` repairs what it can.
set -eu
cd "$(dirname "$0")/../.."
sh core/toolchain/setup.sh test

npx biome check .
npx tsc
find core wasm tests \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 clang-format --dry-run -Werror

cmake --preset lint >/dev/null # for compile_commands.json, and files that hold a folder each
# shellcheck disable=SC2016 # $0 is the inner shell's: one file
node -p '
  JSON.parse(fs.readFileSync("build/lint/compile_commands.json"))
    .filter(({ command }) => command.includes(" -o CMakeFiles/dualblock-core.dir/"))
    .map(({ file }) => file).join("\0")' | tr -d '\n' | xargs -0 -n 1 -P 2 sh -c '
  report=$(clang-tidy --quiet --extra-arg=-Wno-unknown-warning-option -p build/lint "$0" 2>&1) || {
    printf "%s\n" "$report"
    exit 1
  }'
echo 'lint: no findings'
