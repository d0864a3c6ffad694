# SPDX-License-Identifier: Apache-2.0
# Prints the SPDX 2.3 description of what an image has, from lists of packages and the copyright files that these bring.
#
# usage: awk -v name=NAME -v version=VERSION -v created=TIME [-v others=FILES] -f board/image/licences.awk root=FOLDER LIST...
#        LIST has `package version source source-version` on each line, FOLDER usr/share/doc/PACKAGE/copyright. FILES are
#        those of a boot chain that nobody has packed.
#
# A copyright file in Debian's machine-readable form names a licence for each group of files; all of these are told, joined
# by AND. SPDX's own names are used where they mean the same, LicenseRef- with the file's text where not. For other copyright
# files nobody has said what they mean: NOASSERTION. All of them are in the image.

# The SPDX name of one of Debian's, which has no "and" or "or".
function licence(debian,    plain, exception) {
    plain = tolower(debian)
    exception = sub(/ with linux-syscall-note exception$/, "", plain) ? " WITH Linux-syscall-note" : ""
    if (plain ~ /^l?gpl-[123]\.0\+?$/)
        sub(/\.0/, "", plain)
    return plain in same ? same[plain] exception : reference(debian)
}

function reference(debian,    id) {
    id = debian
    gsub(/\+/, "-or-later", id)
    gsub(/[^A-Za-z0-9.]+/, "-", id)
    gsub(/^-|-$/, "", id)
    id = "LicenseRef-Debian-" id
    if (!(id in debians_name)) {
        debians_name[id] = debian
        references[++count_of_references] = id
    }
    if (index(" " users[id] " ", " " package " ") == 0)
        users[id] = users[id] (users[id] == "" ? "" : " ") package
    return id
}

# "A or B and C" in SPDX's form; AND binds closer in both.
function without_comma(text,    choices, parts, count, joint, i, j, result) {
    count = split(text, choices, / +[oO][rR] +/)
    for (i = 1; i <= count; i++) {
        joint = split(choices[i], parts, / +[aA][nN][dD] +/)
        for (j = 1; j <= joint; j++)
            result = result (j > 1 ? " AND " : i > 1 ? " OR " : "") licence(parts[j])
    }
    return result
}

# "and" behind a comma binds less close than all before it.
function expression(text,    groups, count, i, result, part) {
    if (text ~ /, +or /)
        return reference(text)
    count = split(text, groups, /, +and +/)
    for (i = 1; i <= count; i++) {
        part = without_comma(groups[i])
        result = result (i > 1 ? " AND " : "") (part ~ / OR / ? "(" part ")" : part)
    }
    return result
}

# A licence's text is what is indented below its name.
function keep_text(id, text) {
    sub(/\n+$/, "", text)
    gsub(/<\/?text>/, "", text)
    if (text != "" && id in debians_name && !((id, text) in kept)) {
        kept[id, text] = 1
        texts[id] = texts[id] (texts[id] == "" ? "" : "\n\n----\n\n") text
    }
}

function declared(file,    line, one, seen, result, readable, text, parts, count, i) {
    readable = (getline line < file) > 0 && line ~ /^Format: *https?:\/\/(www\.)?debian\.org\/doc\/packaging-manuals\/copyright-format/
    while (readable && (getline line < file) > 0)
        if (line ~ /^[ \t]/) {
            sub(/^[ \t]\.?/, "", line)
            text = text line "\n"
        } else {
            keep_text(one, text)
            one = text = ""
            if (line !~ /^License: *[^ ]/)
                continue
            gsub(/^License: *| +$/, "", line)
            one = expression(line)
            count = one ~ / OR / ? 1 : split(one, parts, " AND ")
            if (count == 1)
                parts[1] = one
            for (i = 1; i <= count; i++)
                if (!(parts[i] in seen)) {
                    seen[parts[i]] = 1
                    result = result (result == "" ? "" : " AND ") parts[i]
                }
        }
    keep_text(one, text)
    close(file)
    return result == "" ? "NOASSERTION" : result
}

function identifier(text) {
    gsub(/[^A-Za-z0-9.-]/, "-", text)
    return "SPDXRef-" text
}

function describe(name, id, version, supplier, licences) {
    print "\n##### Package: " name "\n"
    print "PackageName: " name "\nSPDXID: " id "\nPackageVersion: " version "\nPackageSupplier: " supplier
    print "PackageDownloadLocation: NOASSERTION\nFilesAnalyzed: false"
    print "PackageLicenseConcluded: NOASSERTION\nPackageLicenseDeclared: " licences "\nPackageCopyrightText: NOASSERTION"
    print "Relationship: " (id == image ? "SPDXRef-DOCUMENT DESCRIBES " : image " CONTAINS ") id
}

BEGIN {
    split("AFL-2.0 AFL-2.0 AFL-2.1 AFL-2.1 Apache-2 Apache-2.0 Apache-2.0 Apache-2.0 Artistic Artistic-1.0-Perl " \
        "Artistic-2 Artistic-2.0 Artistic-2.0 Artistic-2.0 BSD-2-clause BSD-2-Clause BSD-3-clause BSD-3-Clause BSD-4-clause " \
        "BSD-4-Clause CC-BY-4.0 CC-BY-4.0 CC-BY-SA-3.0 CC-BY-SA-3.0 CC-BY-SA-4.0 CC-BY-SA-4.0 CC0 CC0-1.0 CC0-1.0 CC0-1.0 " \
        "Expat MIT GFDL-1.3+ GFDL-1.3-or-later GPL-1 GPL-1.0-only GPL-1+ GPL-1.0-or-later GPL-2 GPL-2.0-only GPL-2+ " \
        "GPL-2.0-or-later GPL-3 GPL-3.0-only GPL-3+ GPL-3.0-or-later ISC ISC LGPL-2 LGPL-2.0-only LGPL-2+ " \
        "LGPL-2.0-or-later LGPL-2.1 LGPL-2.1-only LGPL-2.1+ LGPL-2.1-or-later LGPL-3 LGPL-3.0-only LGPL-3+ " \
        "LGPL-3.0-or-later MIT MIT MPL-1.1 MPL-1.1 MPL-2.0 MPL-2.0 Unlicense Unlicense Zlib Zlib", pair, " ")
    for (i = 1; i in pair; i += 2)
        same[tolower(pair[i])] = pair[i + 1]
    image = identifier("Image")
    print "SPDXVersion: SPDX-2.3\nDataLicense: CC0-1.0\nSPDXID: SPDXRef-DOCUMENT"
    print "DocumentName: " name
    print "DocumentNamespace: https://spdx.org/spdxdocs/" name "-" version "-" created
    print "Creator: Tool: wallwarp-make-image\nCreated: " created
    print "DocumentComment: <text>Packages that the image was made of; some of their files were left out.</text>"
    describe(name, image, version, "NOASSERTION", "NOASSERTION")
    describe("wallwarp", identifier("Package-wallwarp"), version, "NOASSERTION", "Apache-2.0")
    if (others != "") {
        describe(name "-boot", identifier("Boot"), "NOASSERTION", "NOASSERTION", "NOASSERTION")
        print "PackageComment: <text>files that who made the image has named: " others "</text>"
    }
}

{
    package = $1
    describe(package, identifier("Package-" package), $2, "Organization: Debian",
        declared(root "/usr/share/doc/" package "/copyright"))
    print "PackageSourceInfo: <text>source package " $3 " " $4 "</text>"
    purl = $2
    gsub(/:/, "%3A", purl)
    gsub(/\+/, "%2B", purl)
    print "ExternalRef: PACKAGE-MANAGER purl pkg:deb/debian/" package "@" purl
}

END {
    for (i = 1; i <= count_of_references; i++) {
        id = references[i]
        print "\nLicenseID: " id
        print "LicenseName: " debians_name[id]
        print "ExtractedText: <text>" (id in texts ? texts[id] : "Only named, in the copyright files of: " users[id]) "</text>"
    }
}
