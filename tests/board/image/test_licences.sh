#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The list of what is in an image: packages that are made up and, where they have been fetched, Debian's real ones. Each list
# is read by rules of SPDX, with its own lists of licences; and what those rules must find in a bad list is found.
# Usage, from the tree's root: tests/board/image/test_licences.sh [BUILD]
set -u
# shellcheck source=tests/support/checks.sh
. tests/support/checks.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
list=$folder/list.spdx

# words FILE: the strings of one of SPDX's lists.
words() { grep -o '"[^"]*"' "/usr/share/nodejs/$1/index.json" | tr -d '"' | xargs; }
licences=$(words spdx-license-ids)
exceptions=$(words spdx-exceptions)
valid() { awk -v licences="$licences" -v exceptions="$exceptions" -f tests/board/image/spdx.awk "$1" >"$folder/wrong" 2>&1; }
wrong() {
    valid "$1"
    [ $? = 1 ] && grep -q '^line [0-9]*: ' "$folder/wrong"
}

# package NAME VERSION SOURCE LINE...: one of Debian's, with a copyright file of these lines after its head; none: in prose.
package() {
    local docs=$folder/root/usr/share/doc/$1 head='Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/'
    echo "$1 $2 $3 $2" >>"$folder/packages"
    mkdir -p "$docs"
    shift 3
    if [ $# = 0 ]; then echo "It may be copied." >"$docs/copyright"; else printf '%s\n' "$head" "$@" >"$docs/copyright"; fi
}

# declares PACKAGE EXPRESSION
declares() {
    local found
    found=$(awk -v name="PackageName: $1" '$0 == name { on = 1 } on && sub(/^PackageLicenseDeclared: /, "") { print; exit }' "$list")
    [ "$found" = "$2" ]
    ok $? "$1 declares $found, expected $2"
}

# texts ID LINE...: the licence's text is these lines.
texts() {
    local found
    found=$(awk -v id="LicenseID: $1" '$0 == id { on = 1 } on && sub(/^ExtractedText: <text>/, "") { out = 1 }
        out { print } /<\/text>/ { if (out) exit }' "$list")
    shift
    [ "$found" = "$(printf '%s\n' "$@")</text>" ]
    ok $? "text: $found, expected $*"
}

package plain 1:2.0+b1 plain 'License: Expat'
package libboth++6 2.0~rc1 both 'License: GPL-2+ or Artistic' '' 'License: gpl-3.0+' '' 'License: GPL-2+ or Artistic'
package order 1 order 'License: GPL-1 or ISC and Zlib' '' 'License: ISC or Zlib, and Expat'
package kernel 1 kernel 'License: GPL-2 with Linux-syscall-note exception and LGPL-2.1'
package own 1 own 'License: ours+' ' Copy it,' ' .' ' all of it.' '' 'License: ours+ and Expat' '' 'License: theirs'
package again 1 again 'License: ours+' ' Copy half.' '' 'License: ours+' ' Copy half.'
package prose 1 prose
echo "absent 1 absent 1" >>"$folder/packages"
describe() { awk -v name=made-up -v version=1.0 -v created=2026-11-23T00:00:00Z "$@" -f board/image/licences.awk root="$folder/root" \
    "$folder/packages"; }
describe >"$list"
valid "$list"
ok $? "the made-up list: $(cat "$folder/wrong")"
declares made-up NOASSERTION
declares wallwarp Apache-2.0
declares plain MIT
declares libboth++6 '(GPL-2.0-or-later OR Artistic-1.0-Perl) AND GPL-3.0-or-later'
declares order '(GPL-1.0-only OR ISC AND Zlib) AND (ISC OR Zlib) AND MIT'
declares kernel 'GPL-2.0-only WITH Linux-syscall-note AND LGPL-2.1-only'
declares own 'LicenseRef-Debian-ours-or-later AND MIT AND LicenseRef-Debian-theirs'
declares prose NOASSERTION
declares absent NOASSERTION
texts LicenseRef-Debian-ours-or-later 'Copy it,' '' 'all of it.' '' ---- '' 'Copy half.'
texts LicenseRef-Debian-theirs 'Only named, in the copyright files of: own'
grep -qx 'ExternalRef: PACKAGE-MANAGER purl pkg:deb/debian/plain@1%3A2.0%2Bb1' "$list"
ok $? "no package URL"
describe -v others='flash.bin vmlinuz' >"$folder/others"
valid "$folder/others" && grep -q '^PackageComment: .*: flash.bin vmlinuz<' "$folder/others"
ok $? "a boot chain of others: $(cat "$folder/wrong")"

# What must be there is missed, line by line; and what is wrong is found.
for tag in SPDXVersion DataLicense SPDXID DocumentName DocumentNamespace Creator Created PackageName PackageDownloadLocation \
    FilesAnalyzed LicenseID LicenseName ExtractedText Relationship; do
    awk -v tag="$tag:" '$1 == tag && !done { done = 1; next } { print }' "$list" >"$folder/bad"
    wrong "$folder/bad"
    ok $? "a list without its first $tag is taken"
done
for change in 's/MIT/MIT-like/' 's/GPL-1.0-only/GPL-1.0/' 's/AND Zlib/Zlib/' 's/ISC OR/ISC OR OR/' 's/(ISC/ISC/' 's/Linux-syscall-note/some-note/' \
    's/^LicenseID: .*theirs/LicenseID: LicenseRef-Debian-his/' 's/<.text>//' 's/T00:00:00Z/ 00:00/' 's/Tool: //' 's/SPDX-2.3/SPDX-3/' \
    's/SPDXRef-Package-own/SPDXRef-Package-order/' 's/^PackageVersion/Version/' 's/DESCRIBES/DEPICTS/' 's/^FilesAnalyzed: false/FilesAnalyzed: true/'; do
    sed "$change" "$list" >"$folder/bad"
    ! cmp -s "$list" "$folder/bad" && wrong "$folder/bad"
    ok $? "a list with $change is taken"
done

if [ -e build/image.made ]; then
    mkdir "$folder/out"
    echo 1.0 >"$folder/out/version"
    for board in qemu-virt imx8mp; do
        board/image/licences.sh $board build/image "$folder/out" 2026-11-23T00:00:00Z >"$list"
        ok $? "$board: licences.sh failed"
        valid "$list"
        ok $? "$board: $(head -n 5 "$folder/wrong")"
        [ "$(grep -c '^PackageName: linux-image-' "$list")" = "$([ $board = qemu-virt ] && echo 1 || echo 0)" ]
        ok $? "$board: $(grep '^PackageName: linux' "$list")"
    done
    declares systemd "$(sed -n '/^PackageName: libudev1$/,/^PackageCopyright/s/^PackageLicenseDeclared: //p' "$list")"
    declares squashfs-tools ''
fi
ok_end
