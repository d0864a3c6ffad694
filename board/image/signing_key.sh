#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes what bundles are signed with: board/image/signing_key.sh FOLDER. Elliptic keys (P-256), X.509 certificates.
#
#   ca.key        makes new signing certificates. Needed again in two years: keep it off this machine, on two sticks
#   ca.pem        goes into images: a board takes bundles of certificates that ca.key has made, and of no others
#   signing.key   signs bundles: on the machine that makes them
#   signing.pem   its certificate, good for two years from now
# With ca.key and ca.pem already there, it makes a new signing.key and signing.pem only.
# A board may not know the time; certificates are good from 2020 on, so that no board finds one too new.
set -euo pipefail
[ $# = 1 ] || { echo "usage: board/image/signing_key.sh FOLDER" >&2; exit 2; }
folder=$1
umask 077
mkdir -p "$folder"
if git -C "$folder" rev-parse --is-inside-work-tree >/dev/null 2>&1 && ! git -C "$folder" check-ignore -q .; then
    echo "signing-key: $folder is in a git tree, where a private key may be committed; name a folder outside" >&2
    exit 1
fi
if [ -e "$folder/signing.key" ] && [ ! "$folder/signing.key" -ot "$folder/ca.pem" ] && [ -z "${RENEW-}" ]; then
    echo "signing-key: $folder/signing.key is there already; to replace it, say RENEW=1" >&2
    exit 1
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: >"$work/index"
cat >"$work/config" <<'CONFIG'
[ca]
default_ca = here
[here]
database = $ENV::WORK/index
new_certs_dir = $ENV::WORK
rand_serial = yes
default_md = sha256
policy = any
unique_subject = no
[any]
organizationName = optional
commonName = supplied
[req]
distinguished_name = name
[name]
[authority]
basicConstraints = critical, CA:TRUE, pathlen:0
keyUsage = critical, keyCertSign, cRLSign
subjectKeyIdentifier = hash
[signer]
basicConstraints = critical, CA:FALSE
keyUsage = critical, digitalSignature
subjectKeyIdentifier = hash
authorityKeyIdentifier = keyid
CONFIG
export WORK=$work

# certificate NAME SUBJECT END KIND [ARGUMENT...]: a key and its certificate.
certificate() {
    local name=$1 subject=$2 end=$3 kind=$4
    shift 4
    openssl req -config "$work/config" -new -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj "$subject" \
        -keyout "$work/$name.key" -out "$work/$name.csr" 2>/dev/null
    openssl ca -config "$work/config" -batch -notext -startdate 20200101000000Z -enddate "$end" -extensions "$kind" \
        -in "$work/$name.csr" -out "$work/$name.pem" "$@" 2>"$work/said" || { cat "$work/said" >&2; exit 1; }
    mv "$work/$name.key" "$work/$name.pem" "$folder/"
}

if [ ! -e "$folder/ca.key" ] || [ ! -e "$folder/ca.pem" ]; then
    certificate ca '/O=wallwarp/CN=updates of these boards' 20991231235959Z authority -selfsign -keyfile "$work/ca.key"
fi
certificate signing "/O=wallwarp/CN=bundles signed from $(date -u +%Y-%m-%d)" "${END:-$(date -u -d '2 years' +%Y%m%d%H%M%SZ)}" \
    signer -cert "$folder/ca.pem" -keyfile "$folder/ca.key"
cat >&2 <<SAID
signing-key: made $folder/signing.key and signing.pem
  make image  with CA=$folder/ca.pem
  make bundle with SIGNING_KEY=$folder/signing.key SIGNING_CERT=$folder/signing.pem
  Keep $folder/ca.key off this machine. Who has one of the two .key files can put anything on your boards: never
  commit them, never mail them.
SAID
