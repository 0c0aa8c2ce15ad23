#!/bin/sh
# Make and check a release: all tests and the checked wheels of a clean clone of HEAD, which go to dist/.
#
#   release/release.sh [--without-tests] [--without-download]
#
# --without-tests     leaves out `make test`, `make soak` (three hours) and the check of pictures, for a trial of all the rest
# --without-download  leaves out fetching each wheel's dependencies (half a gigabyte); they are still resolved
#
# Afterwards release/upload.py uploads dist/, and goes on after a failure.
set -eu
cd "$(dirname "$0")/.."
tests=yes download=--download
for option; do
    case $option in
    --without-tests) tests= ;;
    --without-download) download= ;;
    *) echo "release.sh takes --without-tests and --without-download, not $option" >&2; exit 2 ;;
    esac
done
if [ -n "$(git status --porcelain)" ]; then
    echo "There are changes that are not committed: a release is made of commits." >&2
    exit 1
fi
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
git clone --quiet . "$clone"
[ -z "$tests" ] || make -C "$clone" test soak
# pictures that are older than what they show are named, and end it
[ -z "$tests" ] || make -C "$clone" pictures CHECK=1
make -C "$clone" wheels
if [ -n "$download" ]; then
    (cd "$clone" && build/release/bin/python release/wheels.py dist --check-only --no-index $download)
fi
# the wheel of this machine, with what pip brings, where there is no checkout
python3 -m venv "$clone/build/installed"
"$clone/build/installed/bin/python" -m pip install --quiet --disable-pip-version-check \
    "$clone"/dist/garage2usd-*-manylinux*_"$(uname -m)".whl
(cd "$clone/build" && installed/bin/garage2usd doctor)
mkdir -p dist
rm -f dist/garage2usd-*
cp "$clone"/dist/garage2usd-* dist/
ls -l dist
[ -n "$tests" ] || echo "NOT TESTED: --without-tests left the tests out; do not upload this."
