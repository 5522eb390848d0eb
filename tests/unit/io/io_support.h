/// Helpers shared by the tests of mesh files: meshes with every kind of data, their comparison, a
/// log to look into, and a folder that goes away.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/io/mesh_file.h"
#include "tests/unit/support.h"

namespace lissom::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A context whose log can be read.
class LoggedContext {
  public:
    LoggedContext() : context(options()) {}

    const std::string& log() const { return *log_; }
    bool mentions(std::string_view text) const { return log_->find(text) != std::string::npos; }

  private:
    ContextOptions options() const {
        ContextOptions result;
        result.log = [log = log_](LogLevel, std::string_view message) {
            *log += std::string(message) + "\n";
        };
        return result;
    }

    std::shared_ptr<std::string> log_ = std::make_shared<std::string>();

  public:
    Context context;
};

/// A new folder that is removed with all it holds.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::random_device random;
        path_ =
            std::filesystem::temp_directory_path() / ("lissom-test-" + std::to_string(random()));
        std::filesystem::create_directories(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }

    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
    /// Names of the files inside, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> list;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            list.push_back(entry.path().filename().string());
        }
        std::sort(list.begin(), list.end());
        return list;
    }

  private:
    std::filesystem::path path_;
};

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Joins numbers to binary data in the given byte order.
class Bytes {
  public:
    explicit Bytes(std::string_view start = "", bool big_endian = false)
        : bytes_(start), big_endian_(big_endian) {}

    template <typename... Numbers>
    Bytes& add(Numbers... numbers) {
        (append(numbers), ...);
        return *this;
    }
    operator std::string() const { return bytes_; }

  private:
    template <typename T>
    void append(T number) {
        std::string raw(sizeof(T), '\0');
        std::memcpy(raw.data(), &number, sizeof(T));
        const std::uint16_t one = 1;
        const bool machine_is_big = *reinterpret_cast<const unsigned char*>(&one) == 0;
        if (machine_is_big != big_endian_) std::reverse(raw.begin(), raw.end());
        bytes_ += raw;
    }

    std::string bytes_;
    bool big_endian_;
};

/// A closed prism over an n-gon: n quads between two n-gons. Its positions need all digits of a
/// double.
inline Mesh prism(Index n) {
    std::vector<Vec3> positions;
    for (const double z : {0.1, 1.0 / 3.0}) {
        for (Index i = 0; i < n; ++i) {
            const double angle = 2.0 * kPi * i / n;
            positions.emplace_back(std::cos(angle), std::sin(angle) + 7.0, -z);
        }
    }
    FaceList faces;
    std::vector<Index> top, bottom;
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        faces.add({j, i, n + i, n + j});
        top.push_back(i);
        bottom.push_back(2 * n - 1 - i);
    }
    faces.add(top);
    faces.add(bottom);
    return Mesh(std::move(positions), std::move(faces));
}

/// `count` numbers between 0 and 1 that do not repeat.
inline std::vector<double> numbers(Index count, unsigned seed) {
    std::mt19937 generator(seed);
    std::vector<double> values;
    for (Index i = 0; i < count; ++i) values.push_back((generator() + 0.5) / 4294967296.0);
    return values;
}

inline std::vector<double> rounded_to_bytes(std::vector<double> values) {
    for (double& value : values) value = std::round(value * 255.0) / 255.0;
    return values;
}

inline std::vector<double> rounded_to_floats(std::vector<double> values) {
    for (double& value : values) {
        const volatile float narrow = static_cast<float>(value);
        value = narrow;
    }
    return values;
}

inline bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
        return x == y || (std::isnan(x) && std::isnan(y));
    });
}

inline void check_same_attribute(const Mesh& a, const Mesh& b, std::string_view name) {
    CAPTURE(name);
    const Attribute* x = a.attributes().find(name);
    const Attribute* y = b.attributes().find(name);
    REQUIRE(x);
    REQUIRE(y);
    CHECK(x->domain == y->domain);
    CHECK(x->width == y->width);
    CHECK(x->type == y->type);
    CHECK(same_numbers(x->values, y->values));
}

/// The label of each face, "" for none.
inline std::vector<std::string> label_of_each_face(const Mesh& mesh, std::string_view kind) {
    std::vector<std::string> list(static_cast<std::size_t>(mesh.face_count()));
    const auto found = mesh.attributes().labels().find(kind);
    if (found == mesh.attributes().labels().end()) return list;
    const FaceLabels& labels = found->second;
    for (std::size_t f = 0; f < list.size(); ++f) {
        if (labels.of_face[f] != kNoIndex) list[f] = labels.names[labels.of_face[f]];
    }
    return list;
}

inline void check_same_geometry(const Mesh& a, const Mesh& b) {
    REQUIRE(a.vertex_count() == b.vertex_count());
    CHECK(std::equal(a.positions().begin(), a.positions().end(), b.positions().begin()));
    CHECK(a.topology().faces().offsets == b.topology().faces().offsets);
    CHECK(a.topology().faces().vertices == b.topology().faces().vertices);
}

/// Checks that everything is the same, in the same order where order matters.
inline void check_same_mesh(const Mesh& a, const Mesh& b) {
    check_same_geometry(a, b);
    CHECK(a.attributes().all().size() == b.attributes().all().size());
    for (const Attribute& attribute : a.attributes().all())
        check_same_attribute(a, b, attribute.name);
    CHECK(a.attributes().labels().size() == b.attributes().labels().size());
    for (const auto& entry : a.attributes().labels()) {
        CAPTURE(entry.first);
        CHECK(label_of_each_face(a, entry.first) == label_of_each_face(b, entry.first));
    }
    CHECK(a.material_libraries() == b.material_libraries());
}

inline void check_same_regions(const Mesh& a, const Mesh& b) {
    REQUIRE(a.regions().size() == b.regions().size());
    for (const auto& entry : a.regions()) {
        const std::string& name = entry.first;
        CAPTURE(name);
        REQUIRE(b.find_region(name));
        CHECK(b.find_region(name)->vertices() == entry.second.vertices());
    }
}

/// Encodes and decodes.
inline Mesh round_trip(const Mesh& mesh, std::string_view extension,
                       const SaveOptions& options = {}) {
    return decode_mesh(encode_mesh(mesh, extension, options), extension);
}

inline std::vector<Index> face_of(const Mesh& mesh, Index f) {
    const auto face = mesh.topology().face(f);
    return {face.begin(), face.end()};
}

}  // namespace lissom::test
