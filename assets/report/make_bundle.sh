#!/usr/bin/env bash
# Makes three.min.js, the part of three.js that the page of kerf report needs, as the global THREE: needs npm and the
# network, which the build does not.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.180.0 esbuild@0.25.10
cp "$here/three_used.js" .
{
    printf '/*! three.js 0.180.0, https://threejs.org\n%s\n*/\n' "$(cat node_modules/three/LICENSE)"
    node_modules/.bin/esbuild three_used.js --bundle --minify --format=iife --global-name=THREE --target=es2020 \
        --legal-comments=none --charset=utf8
} >"$here/three.min.js"
