#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "kernel/solve/sparse/supernodes.h"
#include "tests/unit/solve/sparse/cholmod_oracle.h"
#include "tests/unit/solve/sparse/matrices.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

void check_same(const SymmetricMatrix& a) {
    const Supernodes ours = analyze_supernodes(a), theirs = test::cholmod_supernodes(a);
    CHECK(ours.permutation == theirs.permutation);
    CHECK(ours.super == theirs.super);
    CHECK(ours.first_row == theirs.first_row);
    CHECK(ours.first_value == theirs.first_value);
    CHECK(ours.row == theirs.row);
}

// The vertices of each face of an OBJ file, which are numbered from 1.
std::vector<std::vector<Index>> faces_of(const std::filesystem::path& file) {
    std::vector<std::vector<Index>> faces;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("f ", 0) != 0) continue;
        std::istringstream words(line.substr(2));
        faces.emplace_back();
        for (std::string word; words >> word;) faces.back().push_back(std::stoi(word) - 1);
    }
    return faces;
}

// The pattern of the squared Laplacian: vertices up to two edges apart.
SymmetricMatrix two_rings(const std::vector<std::vector<Index>>& faces) {
    std::map<Index, std::set<Index>> ring;
    for (const std::vector<Index>& face : faces) {
        for (const Index a : face) ring[a].insert(face.begin(), face.end());
    }
    std::vector<std::pair<Index, Index>> pairs;
    for (const auto& [center, around] : ring) {
        for (const Index a : around) {
            for (const Index b : around) {
                if (a < b) pairs.emplace_back(a, b);
            }
        }
    }
    return test::dominant(ring.rbegin()->first + 1, pairs);
}

}  // namespace

TEST_CASE("supernodes: the ordering and every array are CHOLMOD's, for every structure") {
    for (const test::NamedMatrix& named : test::matrices()) {
        CAPTURE(named.name);
        check_same(named.matrix);
    }
}

TEST_CASE("supernodes: as CHOLMOD's, for random patterns from trees to nearly dense") {
    for (unsigned seed = 1; seed < 300; ++seed) {
        CAPTURE(seed);
        const auto n = static_cast<Index>(5 + seed % 97 * 7);
        check_same(test::random_pattern(n, n * static_cast<Index>(seed % 6) / 2 + 1, seed));
    }
}

TEST_CASE("supernodes: as CHOLMOD's, for grids of several stencils") {
    for (const Index reach : {1, 2, 3}) {
        for (const Index width : {1, 3, 17, 80, 150}) {
            CAPTURE(reach);
            CAPTURE(width);
            check_same(test::grid(width, 60, reach));
        }
    }
}

TEST_CASE("supernodes: as CHOLMOD's, for real meshes") {
    for (const char* name : {"models/hand_plain.obj", "models/armadillo_43k.obj"}) {
        CAPTURE(name);
        const auto path = test::data_file(name);
        if (!path) continue;
        check_same(two_rings(faces_of(*path)));
    }
}
