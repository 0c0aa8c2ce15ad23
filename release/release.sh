#!/bin/sh
# What a release is made of: all tests and the checked wheels of a clean clone, which go to dist/. Uploading is by hand.
set -eu
cd "$(dirname "$0")/.."
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
git clone --quiet . "$clone"
make -C "$clone" test
make -C "$clone" wheels
mkdir -p dist
cp "$clone"/dist/garage2usd-* dist/
ls -l dist
