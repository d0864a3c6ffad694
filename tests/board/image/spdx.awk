# SPDX-License-Identifier: Apache-2.0
# Checks an SPDX 2.3 document in tag-value form against the specification's clauses 6 to 11 and annex D, as far as a list of
# packages needs them; says what is wrong, one a line. Exit status: 0 nothing.
#
# usage: awk -f tests/board/image/spdx.awk -v licences='ID...' -v exceptions='ID...' FILE      of SPDX's lists, not deprecated
BEGIN {
    fill(known, licences)
    fill(exception, exceptions)
    # Sections: which tags, and which of them must be there; a tag that may come more often has a +.
    begin["SPDXVersion"] = "document"
    begin["PackageName"] = "package"
    begin["LicenseID"] = "licence"
    must["document"] = "SPDXVersion DataLicense SPDXID DocumentName DocumentNamespace Creator Created"
    may["document"] = "Creator+ CreatorComment DocumentComment LicenseListVersion Relationship+"
    must["package"] = "PackageName SPDXID PackageDownloadLocation FilesAnalyzed"
    may["package"] = "PackageVersion PackageFileName PackageSupplier PackageOriginator PackageChecksum+ PackageHomePage " \
        "PackageSourceInfo PackageLicenseConcluded PackageLicenseDeclared PackageLicenseComments PackageCopyrightText " \
        "PackageSummary PackageDescription PackageComment ExternalRef+ PrimaryPackagePurpose Relationship+"
    must["licence"] = "LicenseID ExtractedText LicenseName"
    may["licence"] = "LicenseCrossReference+ LicenseComment"
    who = "^(NOASSERTION|(Person|Organization): .+)$"
    form["SPDXVersion"] = "^SPDX-2\\.3$"
    form["DataLicense"] = "^CC0-1\\.0$"
    form["SPDXID"] = "^SPDXRef-[A-Za-z0-9.-]+$"
    form["DocumentNamespace"] = "^https?://[^ #]+$"
    form["Creator"] = "^(Person|Organization|Tool): .+$"
    form["Created"] = "^[0-9][0-9][0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-5][0-9]Z$"
    form["PackageSupplier"] = form["PackageOriginator"] = who
    form["FilesAnalyzed"] = "^false$" # with true a verification code and files would be needed
    form["PrimaryPackagePurpose"] = "^(APPLICATION|FRAMEWORK|LIBRARY|CONTAINER|OPERATING-SYSTEM|DEVICE|FIRMWARE|SOURCE|ARCHIVE|FILE|INSTALL|OTHER)$"
    form["ExternalRef"] = "^PACKAGE-MANAGER purl pkg:deb/debian/[a-z0-9.+-]+@[A-Za-z0-9.~%-]+$"
    form["LicenseID"] = "^LicenseRef-[A-Za-z0-9.-]+$"
    form["Relationship"] = "^SPDXRef-[A-Za-z0-9.-]+ (DESCRIBES|CONTAINS) SPDXRef-[A-Za-z0-9.-]+$"
}

function fill(list, text,    words, i) {
    split(text, words, / +/)
    for (i in words)
        list[words[i]] = 1
}

function wrong(what) {
    print "line " NR ": " what
    any = 1
}

function end_section(    words, i) {
    split(must[section], words, " ")
    for (i in words)
        if (!(words[i] in had))
            wrong(section " " name " has no " words[i])
    split("", had)
}

# Expressions of annex D: one or more terms joined by AND, OR; a term is a licence, with an exception or not, or a group.
function is_expression(text,    count, i, depth, before, word) {
    gsub(/[()]/, " & ", text)
    gsub(/^ +| +$/, "", text)
    count = split(text, term, / +/)
    before = "("
    for (i = 1; i <= count; i++) {
        word = term[i]
        if (word == "(" || word == ")") {
            depth += word == "(" ? 1 : -1
            if (depth < 0 || before == "with" || (word == "(") != (before == "(" || before == "op"))
                return 0
            before = word == "(" ? "(" : "term"
        } else if (word == "AND" || word == "OR" || word == "WITH") {
            if (before != (word == "WITH" ? "licence" : before == "licence" ? "licence" : "term"))
                return 0
            before = word == "WITH" ? "with" : "op"
        } else if (before == "with") {
            if (!(word in exception))
                return 0
            before = "term"
        } else {
            if (before != "(" && before != "op")
                return 0
            if (word ~ /^LicenseRef-/)
                used[word] = NR
            else if (!(word in known))
                return 0
            before = "licence"
        }
    }
    return depth == 0 && (before == "term" || before == "licence")
}

in_text {
    if (index($0, "</text>"))
        in_text = 0
    next
}
/^(#|$)/ { next }
{
    if (!match($0, /^[A-Za-z]+: /)) {
        wrong("is no `Tag: value`: " $0)
        next
    }
    tag = substr($0, 1, RLENGTH - 2)
    value = substr($0, RLENGTH + 1)
    if (tag in begin) {
        if (section != "")
            end_section()
        else if (tag != "SPDXVersion")
            wrong("the document begins with " tag)
        section = begin[tag]
        name = value
    }
    if (index(" " must[section] " " may[section] " ", " " tag " ") == 0 && index(" " may[section] " ", " " tag "+ ") == 0)
        wrong(tag " does not belong into a " section)
    if (tag in had && index(" " may[section] " ", " " tag "+ ") == 0)
        wrong(tag " is there again")
    had[tag] = 1
    if (tag in form && value !~ form[tag])
        wrong(tag " is " value)
    if (tag ~ /^PackageLicense(Concluded|Declared)$/ && value !~ /^(NONE|NOASSERTION)$/ && !is_expression(value))
        wrong(tag " is no expression of SPDX licences: " value)
    if (tag == "SPDXID" || tag == "LicenseID") {
        if (value in defined)
            wrong(value " is there again")
        defined[value] = NR
    }
    if (tag == "Relationship") {
        split(value, side, " ")
        related[side[1]] = related[side[3]] = NR
        described = described || side[2] == "DESCRIBES" && side[1] == "SPDXRef-DOCUMENT"
    }
    if (index(value, "<text>") && !index(value, "</text>"))
        in_text = 1
}
END {
    end_section()
    if (in_text)
        wrong("a <text> has no end")
    if (!described)
        wrong("the document describes nothing")
    for (id in related)
        if (!(id in defined))
            wrong(id " is related, and nowhere")
    for (id in used)
        if (!(id in defined))
            wrong(id " has no text")
    for (id in defined)
        if (!(id in used || id in related))
            wrong("nothing is said of " id)
    exit any
}
