#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Shells complete, and the manual lists, what the help of each command lists.
#   completion_test.sh CROWDFACE
set -euo pipefail
crowdface=$1
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

fail() {
  echo "$1" >&2
  exit 1
}
# expect_same WHAT EXPECTED FOUND: texts of several words, in any order.
expect_same() {
  local expected found
  expected=$(tr -s ' ' '\n' <<<"$2" | sort -u) found=$(tr -s ' ' '\n' <<<"$3" | sort -u)
  [ "$expected" = "$found" ] || fail "$1: expected (<) and found (>):
$(diff <(echo "$expected") <(echo "$found") || true)"
}
# options_in_help [COMMAND]: the long and short options that the help shows.
options_in_help() {
  "$crowdface" "$@" --help | sed -nE '/^Options:/,/^$/s/^  (-[^ ]+).*/\1/p' | tr ',' '\n'
}

compopt() { :; }  # bash has it in completions only
for shell in bash zsh fish; do "$crowdface" completion $shell >"$place/completion.$shell"; done
"$crowdface" manual >"$place/crowdface.1"
# shellcheck source=/dev/null
. "$place/completion.bash"
# bash_offers WORD …: what bash completes for the last word.
bash_offers() {
  COMP_WORDS=(crowdface "$@") COMP_CWORD=$#
  _crowdface
  echo "${COMPREPLY[@]}"
}

commands=$("$crowdface" --help | sed -nE '/^Subcommands:/,/^$/s/^  ([a-z]+) .*/\1/p')
[ "$(wc -w <<<"$commands")" -gt 15 ] || fail 'expected more commands in the help'
expect_same 'bash, commands' "$commands" "$(bash_offers '')"
expect_same 'bash, options without a command' "$(options_in_help)" "$(bash_offers -)"
[ "$(bash_offers gener)" = generate ] || fail 'bash: expected gener to become generate'
for command in $commands; do
  options=$(options_in_help "$command")
  expect_same "bash, $command" "$options" "$(bash_offers "$command" -)"
  expect_same "zsh, $command" "$options" \
    "$(sed -nE "/^    $command\)/,/;;$/s/^ *'\*?(-[^[]+)\[.*/\1/p" "$place/completion.zsh")"
  expect_same "fish, $command" "$options" "$(sed -nE "s/^complete -c crowdface -n '__fish_seen_subcommand_from $command' //p" \
    "$place/completion.fish" | sed -E "s/ -d '.*//" | grep -oE -- '-(l|s) [^ ]+' | sed -E 's/-l /--/; s/-s /-/')"
  expect_same "manual, $command" "$options" "$(sed -n "/^\.SS $command\$/,/^\.S[SH]/p" "$place/crowdface.1" |
    grep '^\\fB\\-' | sed -E 's/ \\fI.*//; s/\\f[BR]//g; s/\\-/-/g' | tr ',' ' ')"
done
expect_same 'bash, words' 'fixed free' "$(bash_offers smooth --boundary '')"
expect_same 'bash, words of an argument' 'makehuman ict' "$(bash_offers import '')"
[ -z "$(bash_offers generate --out x)" ] || fail 'bash: expected no words for a folder'

# Other shells read their scripts, and man its page.
! command -v zsh >/dev/null || zsh -n "$place/completion.zsh"
if command -v fish >/dev/null; then
  offered=$(HOME=$place fish -c "source '$place/completion.fish'; complete -C 'crowdface plan --re'" | cut -f1)
  [ "$offered" = --review ] || fail "fish: expected --review, found '$offered'"
fi
if command -v groff >/dev/null; then
  warnings=$(groff -man -Tutf8 -ww "$place/crowdface.1" 2>&1 >"$place/page")
  [ -z "$warnings" ] || fail "groff: $warnings"
  grep -q 'Fit a template head to raw scans' "$place/page" || fail 'expected the commands in the page'
fi
