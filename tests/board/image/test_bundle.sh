#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Bundles leave boards with the certificate that their makers have, or say that they don't; and who signs with an expired one
# hears of it before the boards do.
# shellcheck disable=SC2016 # make expands what is in its words
# Usage, from the tree's root: tests/board/image/test_bundle.sh
set -u
# shellcheck source=tests/support/checks.sh
. tests/support/checks.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files=$folder/said

# made CA: a bundle that is signed with the key of `mine`, and brings this certificate.
made() {
    mkdir -p "$folder"/root/{etc/rauc,usr/lib/wallwarp}
    echo 1.0 >"$folder/root/usr/lib/wallwarp/version"
    cp "$1" "$folder/root/etc/rauc/keyring.pem"
    mksquashfs "$folder/root" "$folder/root.squashfs" -noappend -quiet -no-progress &&
        board/image/bundle.sh front "$folder" "$folder/mine/signing.pem" "$folder/mine/signing.key" "$folder/bundle" \
            >"$folder/said" 2>&1
}

for name in mine other; do
    board/image/signing_key.sh "$folder/$name" 2>"$folder/said"
    ok $? "no key is made"
done
head -c 100000 /dev/urandom >"$folder/kernel.vfat"

made "$folder/mine/ca.pem"
ok $? "no bundle is made"
! grep -q 'boards that start this version' "$folder/said"
ok $? "a bundle with its own certificate is complained of"
made "$folder/other/ca.pem"
ok $? "no bundle with another certificate is made"
grep -q 'boards that start this version take nothing more' "$folder/said"
ok $? "nobody says that the next bundle will be refused"

! grep -q expired "$folder/said"
ok $? "a good certificate is called expired"
END=20210101000000Z RENEW=1 board/image/signing_key.sh "$folder/mine" 2>"$folder/said"
made "$folder/mine/ca.pem"
ok $? "no bundle with an expired certificate is made"
grep -q "boards will refuse it: $folder/mine/signing.pem has expired; .* RENEW=1 make DIR=$folder/mine signing-key" "$folder/said"
ok $? "nobody says that the certificate has expired"

made=$(make -s --eval 'print-ca: ; @echo $(CA)' print-ca SIGNING_CERT=keys/signing.pem 2>"$folder/said")
[ "$made" = keys/ca.pem ]
ok $? "make bundle with one's own certificate brings $made"
ok_end
