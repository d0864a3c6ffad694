# SPDX-License-Identifier: Apache-2.0
# Prints the SPDX description of what is in an image, from the list of debian.sh and the copyright files that packages
# bring with them.
#
# usage: awk -v name=NAME -v created=TIME -f board/image/licences.awk folder=FOLDER files=PATTERN place=PLACE LIST ...
#
# FOLDER/PATTERN is the copyright file of a package, whose name is for the pattern's %s; PLACE says where it is in the
# image. The three may be others for each list.
#
# A copyright file in Debian's machine-readable form names a licence for each group of files; all of these are told, joined
# by AND. SPDX's own names are used where they mean the same, LicenseRef- where not: the text is then in the copyright file,
# which is in the image at the place told. For other copyright files nobody has said what they mean: NOASSERTION.

function reference(debian) {
    gsub(/\+/, "-or-later", debian)
    gsub(/[^A-Za-z0-9.]+/, "-", debian)
    gsub(/^-|-$/, "", debian)
    debian = "LicenseRef-Debian-" debian
    if (!(debian in known)) {
        known[debian] = 1
        references[++count_of_references] = debian
    }
    return debian
}

# "GPL-2+ or Artistic" in SPDX's form. What has both "and" and "or" has Debian's own order of them, and is one reference.
function expression(text,    words, count, i, result, word, joint) {
    if (tolower(text) ~ / or / && tolower(text) ~ / and |,/)
        return reference(text)
    joint = tolower(text) ~ / or / ? " OR " : " AND "
    gsub(/,/, " , ", text)
    count = split(text, words, / +/)
    word = result = ""
    for (i = 1; i <= count + 1; i++)
        if (i <= count && tolower(words[i]) !~ /^(and|or|,)$/)
            word = word (word == "" ? "" : " ") words[i]
        else if (word != "") {
            result = result (result == "" ? "" : joint) (tolower(word) in same ? same[tolower(word)] : reference(word))
            word = ""
        }
    return result ~ / OR / ? "(" result ")" : result
}

function declared(file,    line, found, seen, result, readable, one) {
    readable = (getline line < file) > 0 && line ~ /^Format: *https?:\/\/(www\.)?debian\.org\/doc\/packaging-manuals\/copyright-format/
    while (readable && (getline line < file) > 0)
        if (line ~ /^License: *[^ ]/) {
            sub(/^License: */, "", line)
            one = expression(line)
            if (one != "" && !(one in seen)) {
                seen[one] = 1
                result = result (result == "" ? "" : " AND ") one
            }
        }
    close(file)
    return result == "" ? "NOASSERTION" : result
}

BEGIN {
    split("Apache-2.0 Apache-2.0 Artistic Artistic-1.0-Perl BSD-2-clause BSD-2-Clause BSD-3-clause BSD-3-Clause BSD-4-clause " \
        "BSD-4-Clause CC0-1.0 CC0-1.0 Expat MIT GFDL-1.3+ GFDL-1.3-or-later GPL-1 GPL-1.0-only GPL-1+ GPL-1.0-or-later GPL-2 " \
        "GPL-2.0-only GPL-2+ GPL-2.0-or-later GPL-3 GPL-3.0-only GPL-3+ GPL-3.0-or-later ISC ISC LGPL-2 LGPL-2.0-only " \
        "LGPL-2+ LGPL-2.0-or-later LGPL-2.1 LGPL-2.1-only LGPL-2.1+ LGPL-2.1-or-later LGPL-3 LGPL-3.0-only LGPL-3+ " \
        "LGPL-3.0-or-later MIT MIT MPL-2.0 MPL-2.0 Unlicense Unlicense Zlib Zlib", pair, " ")
    for (i = 1; i in pair; i += 2)
        same[tolower(pair[i])] = pair[i + 1]
    print "SPDXVersion: SPDX-2.3\nDataLicense: CC0-1.0\nSPDXID: SPDXRef-DOCUMENT"
    print "DocumentName: " name
    print "DocumentNamespace: https://spdx.org/spdxdocs/" name "-" created
    print "Creator: Tool: wallwarp-make-image\nCreated: " created
    print "DocumentComment: <text>Debian packages that the image was made of; some of their files were left out.</text>"
}

# package version source source-version
{
    file = sprintf(files, $1)
    licence = declared(folder "/" file)
    print "\n##### Package: " $1 "\n"
    print "PackageName: " $1 "\nSPDXID: SPDXRef-Package-" identifier($1) "\nPackageVersion: " $2
    print "PackageSupplier: Organization: Debian\nPackageDownloadLocation: NOASSERTION\nFilesAnalyzed: false"
    print "PackageSourceInfo: <text>source package " $3 " " $4 "</text>"
    print "PackageLicenseConcluded: NOASSERTION\nPackageLicenseDeclared: " licence
    print "PackageLicenseComments: <text>" file " in the image's " place "</text>"
    print "PackageCopyrightText: NOASSERTION"
    version = $2
    gsub(/:/, "%3A", version)
    gsub(/\+/, "%2B", version)
    print "ExternalRef: PACKAGE-MANAGER purl pkg:deb/debian/" $1 "@" version
    print "Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-Package-" identifier($1)
}

function identifier(text) {
    gsub(/[^A-Za-z0-9.-]/, "-", text)
    return text
}

END {
    for (i = 1; i <= count_of_references; i++) {
        print "\nLicenseID: " references[i]
        print "ExtractedText: <text>In the copyright files of the packages that declare it.</text>"
    }
}
