#include "kernel/mesh/report.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lissom {
namespace {

struct KindEntry {
    FindingKind kind;
    std::string_view name, one, many, explanation;
};

constexpr std::array<KindEntry, 20> kKinds{{
    {FindingKind::vertices_welded, "vertices_welded", "vertex welded to another",
     "vertices welded to others", "Merged with another vertex at the same place."},
    {FindingKind::vertices_unreferenced, "vertices_unreferenced", "vertex without faces dropped",
     "vertices without faces dropped", "Used by no face; dropped."},
    {FindingKind::corners_repeated, "corners_repeated", "face with repeated corners simplified",
     "faces with repeated corners simplified",
     "Faces that name a vertex twice in a row; the repeats were dropped."},
    {FindingKind::faces_collapsed, "faces_collapsed",
     "face with fewer than three different vertices dropped",
     "faces with fewer than three different vertices dropped",
     "Faces with fewer than three different vertices; dropped."},
    {FindingKind::faces_pinched, "faces_pinched", "face split where it passed a vertex twice",
     "faces split where they passed a vertex twice",
     "Faces that pass a vertex twice; split there."},
    {FindingKind::faces_duplicate, "faces_duplicate", "copy of a face dropped",
     "copies of faces dropped", "Copies of other faces; dropped."},
    {FindingKind::faces_flipped, "faces_flipped", "face turned over to agree with its neighbours",
     "faces turned over to agree with their neighbours",
     "Faces that ran against their neighbours; turned over."},
    {FindingKind::edges_nonmanifold, "edges_nonmanifold",
     "edge cut open where more than two faces met", "edges cut open where more than two faces met",
     "Edges where more than two faces meet; cut open between the pieces."},
    {FindingKind::edges_unorientable, "edges_unorientable",
     "edge cut open because the surface has one side only",
     "edges cut open because the surface has one side only",
     "Edges cut open because no turning of faces makes both sides agree."},
    {FindingKind::vertices_nonmanifold, "vertices_nonmanifold",
     "vertex split where separate fans of faces touched",
     "vertices split where separate fans of faces touched",
     "Vertices where separate fans of faces touch; each fan got one of its own."},
    {FindingKind::faces_zero_area, "faces_zero_area", "face without area", "faces without area",
     "Faces without area; kept."},
    {FindingKind::faces_sliver, "faces_sliver", "sliver", "slivers",
     "Triangles with an angle below one degree; kept."},
    {FindingKind::components_small, "components_small", "small component", "small components",
     "Components with less than a thousandth of the largest one's area; kept."},
    {FindingKind::components_inverted, "components_inverted", "component inside out",
     "components inside out", "Closed components that face inward; kept."},
    {FindingKind::points_only, "points_only", "point without any face kept",
     "points without any face kept", "The file has no faces; its points were kept."},
    {FindingKind::indices_dangling, "indices_dangling", "reference to a value that does not exist",
     "references to values that do not exist",
     "References to texture coordinates or normals that do not exist."},
    {FindingKind::values_not_finite, "values_not_finite", "value that was not finite dropped",
     "values that were not finite dropped", "Attribute values that were NaN or infinite; dropped."},
    {FindingKind::content_skipped, "content_skipped", "item skipped", "items skipped",
     "Content of the file that a mesh has no place for."},
    {FindingKind::files_missing, "files_missing", "file not found", "files not found",
     "Textures and other files that were not found."},
    {FindingKind::extensions_dropped, "extensions_dropped", "extension dropped",
     "extensions dropped", "Extensions of the format that are not understood; dropped."},
}};

const KindEntry& entry(FindingKind kind) {
    return kKinds[static_cast<std::size_t>(kind)];
}

}  // namespace

std::string_view finding_name(FindingKind kind) {
    return entry(kind).name;
}

std::string_view finding_explanation(FindingKind kind) {
    return entry(kind).explanation;
}

const std::vector<FindingKind>& all_finding_kinds() {
    static const std::vector<FindingKind> kinds = [] {
        std::vector<FindingKind> list;
        for (const KindEntry& e : kKinds) list.push_back(e.kind);
        return list;
    }();
    return kinds;
}

void Report::add(Finding finding) {
    const auto same = std::find_if(findings_.begin(), findings_.end(),
                                   [&](const Finding& f) { return f.kind == finding.kind; });
    if (same == findings_.end()) {
        findings_.push_back(std::move(finding));
        return;
    }
    same->count += finding.count;
    same->ids.insert(same->ids.end(), finding.ids.begin(), finding.ids.end());
    if (finding.message.empty() || finding.message == same->message) return;
    same->message += (same->message.empty() ? "" : "; ") + finding.message;
}

void Report::add(FindingKind kind, std::size_t count, std::string message) {
    add({kind, ElementKind::none, false, count, {}, std::move(message)});
}

const Finding* Report::find(FindingKind kind) const {
    const auto found = std::find_if(findings_.begin(), findings_.end(),
                                    [&](const Finding& f) { return f.kind == kind; });
    return found == findings_.end() ? nullptr : &*found;
}

std::string describe(const Finding& finding) {
    const KindEntry& words = entry(finding.kind);
    return std::to_string(finding.count) + " " +
           std::string(finding.count == 1 ? words.one : words.many);
}

}  // namespace lissom
