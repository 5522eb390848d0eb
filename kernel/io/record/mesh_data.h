/// Data that a reader takes from a file, before a Mesh is made of it; private to kernel/io.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/asset.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/report.h"
#include "kernel/mesh/soup.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// A file to read.
struct FileInput {
    std::string_view bytes;
    /// The folder that files it refers to are in; empty if no other file may be opened.
    std::filesystem::path folder;
};

struct MeshData : Soup {
    std::vector<std::string> material_libraries;
    std::shared_ptr<const Asset> asset;
    /// Omissions and findings of the reader.
    Report report;
    /// True for formats that store each face by itself: all vertices at one place are one.
    bool faces_are_separate = false;
    /// True if `same_as` says all: open edges at one place are apart on purpose.
    bool seams_are_known = false;
};

/// Adds a face. Errors: file_too_large beyond the number of corners that can be numbered.
void add_face(FaceList& faces, std::span<const Index> face);

/// Adds an attribute of faces or vertices; if another domain has one of its name, this one is
/// called "face_<name>", as `face_attribute_name` expects.
void add_without_clash(AttributeSet& attributes, Attribute attribute);

/// Returns the name under which a face attribute stands in a file that tells faces and vertices
/// apart.
std::string face_attribute_name(const AttributeSet& attributes, const Attribute& attribute);

}  // namespace lissom
