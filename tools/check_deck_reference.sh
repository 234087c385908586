#!/bin/sh
# Checks that docs/reference/deck.md is what the schema of the deck says; --update writes it.
# Usage: tools/check_deck_reference.sh [--update] BUILD_FOLDER
set -eu
if [ "${1:-}" = "--update" ]; then
  export FISSURA_UPDATE_REFERENCE=1
  shift
fi
exec "${1:?usage: $0 [--update] BUILD_FOLDER}/tests/unit_deck" --gtest_filter='DeckReference.*' --gtest_brief=1
