#!/bin/sh
# Tells whether the packed build of the page comes from these sources; with --rebuild it builds again and compares.
set -eu
cd "$(dirname "$0")"
packed=../src/pilotage/web/static
if [ "$(node hash-sources.mjs)" != "$(cat "$packed/sources.sha256")" ]; then
    echo "the packed page is not built from frontend/: run 'make page'" >&2
    exit 1
fi
if [ "${1:-}" = --rebuild ]; then
    before=$(find "$packed" -type f -exec sha256sum {} + | sort | sha256sum)
    npm install --silent --no-audit --no-fund && npm run --silent build
    after=$(find "$packed" -type f -exec sha256sum {} + | sort | sha256sum)
    [ "$before" = "$after" ] || { echo "the packed page differs from a fresh build" >&2; exit 1; }
fi
