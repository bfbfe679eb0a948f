#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "tests/common/scan_file/bad_files.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom::testing {
namespace {

const TriangleMesh& Mesh() {
  static const TriangleMesh mesh = MakeSphere(12, 17);
  return mesh;
}

std::string Head(const std::string& format) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(Mesh().vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(Mesh().triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

template <typename T>
std::string Raw(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

std::string GoodBinary() {
  std::string bytes = Head("binary_little_endian");
  for (const Eigen::Vector3d& vertex : Mesh().vertices) {
    for (int axis = 0; axis < 3; ++axis) bytes += Raw(static_cast<float>(vertex[axis]));
  }
  for (const Eigen::Vector3i& triangle : Mesh().triangles) {
    bytes += '\3';
    for (int corner = 0; corner < 3; ++corner) bytes += Raw(triangle[corner]);
  }
  return bytes;
}

std::string GoodText() {
  std::string text = Head("ascii");
  for (const Eigen::Vector3d& vertex : Mesh().vertices) {
    for (int axis = 0; axis < 3; ++axis) text += std::to_string(vertex[axis]) + (axis < 2 ? " " : "\n");
  }
  for (const Eigen::Vector3i& triangle : Mesh().triangles) {
    text += "3 " + std::to_string(triangle[0]) + " " + std::to_string(triangle[1]) + " " + std::to_string(triangle[2]) +
            "\n";
  }
  return text;
}

class PlyFiles {
 public:
  void Add(const std::string& name, std::vector<std::string_view> reasons, std::function<std::string()> make) {
    files_.push_back({"ply_" + name, std::move(reasons), std::move(make)});
  }
  // Both kinds of file with a change in the head.
  void AddHead(const std::string& name, std::vector<std::string_view> reasons, const std::string& from,
               const std::string& to) {
    Add(name + "_text", reasons, [from, to] { return ReplaceFirst(GoodText(), from, to); });
    Add(name + "_binary", reasons, [from, to] { return ReplaceFirst(GoodBinary(), from, to); });
  }
  // A binary file with the bytes at `offset` of its body replaced.
  void AddBody(const std::string& name, std::vector<std::string_view> reasons, size_t offset,
               const std::string& bytes) {
    Add(name, std::move(reasons), [offset, bytes] {
      std::string all = GoodBinary();
      return all.replace(Head("binary_little_endian").size() + offset, bytes.size(), bytes);
    });
  }
  std::vector<BadFile> Take() { return std::move(files_); }

 private:
  std::vector<BadFile> files_;
};

void AddTruncations(PlyFiles& files) {
  for (size_t size = 1024; size < GoodBinary().size(); size += 1024) {
    files.Add("binary_cut_at_" + std::to_string(size / 1024) + "_kib", {"MALFORMED_PLY", "INVALID_COUNT"},
              [size] { return GoodBinary().substr(0, size); });
  }
  for (size_t size = 1024; size < GoodText().size(); size += 1024) {
    files.Add("text_cut_at_" + std::to_string(size / 1024) + "_kib",
              {"MALFORMED_PLY", "INVALID_COUNT", "INDEX_OUT_OF_RANGE"}, [size] { return GoodText().substr(0, size); });
  }
  files.Add("binary_cut_a_byte_short", {"MALFORMED_PLY", "INVALID_COUNT"},
            [] { return GoodBinary().substr(0, GoodBinary().size() - 1); });
  files.Add("binary_a_byte_too_long", {"TRAILING_DATA"}, [] { return GoodBinary() + "x"; });
  files.Add("text_a_row_too_long", {"TRAILING_DATA"}, [] { return GoodText() + "3 0 1 2\n"; });
}

void AddBadHeads(PlyFiles& files) {
  const std::string vertices = "element vertex " + std::to_string(Mesh().vertices.size());
  const std::string faces = "element face " + std::to_string(Mesh().triangles.size());
  for (const char* lie : {"200000000", "4294967295", "9223372036854775807", "18446744073709551616", "-1", "1e99", "NaN",
                          "", "1.5", "0x10"}) {
    files.AddHead(std::string("vertex_count_is_") + lie, {"INVALID_COUNT"}, vertices,
                  std::string("element vertex ") + lie);
    files.AddHead(std::string("face_count_is_") + lie, {"INVALID_COUNT"}, faces, std::string("element face ") + lie);
  }
  files.AddHead("no_vertices",
                {"INVALID_COUNT", "TRAILING_DATA", "MALFORMED_PLY", "INDEX_OUT_OF_RANGE", "MALFORMED_FACE"}, vertices,
                "element vertex 0");
  files.AddHead("no_faces", {"TRAILING_DATA", "NO_TRIANGLES"}, faces, "element face 0");
  files.AddHead("no_end", {"MALFORMED_PLY"}, "end_header\n", "");
  files.AddHead("no_format", {"MALFORMED_PLY"}, "format", "comment");
  files.AddHead("version_2", {"MALFORMED_PLY"}, " 1.0", " 2.0");
  files.AddHead("no_version", {"MALFORMED_PLY"}, " 1.0", "");
  files.AddHead("unknown_type", {"MALFORMED_PLY"}, "property float x", "property quad x");
  files.AddHead("unnamed_property", {"MALFORMED_PLY"}, "property float x", "property float");
  files.AddHead("no_x", {"MALFORMED_PLY"}, "property float x", "property float w");
  files.AddHead("x_is_a_list", {"MALFORMED_PLY"}, "property float x", "property list uchar float x");
  files.AddHead("list_length_is_a_float", {"MALFORMED_PLY"}, "list uchar", "list float");
  files.AddHead("property_first", {"MALFORMED_PLY"}, vertices, "property float q\n" + vertices);
  files.AddHead("vertices_twice", {"MALFORMED_PLY"}, faces, vertices + "\n" + faces);
  files.AddHead("faces_named_otherwise", {"NO_TRIANGLES"}, "element face", "element faces");
  files.AddHead("indices_named_otherwise", {"NO_TRIANGLES"}, "vertex_indices", "corners");
  files.Add("unknown_format", {"MALFORMED_PLY"}, [] { return ReplaceFirst(GoodText(), "ascii", "binary"); });
  files.Add("text_called_binary",
            {"INVALID_COUNT", "MALFORMED_PLY", "COORDINATE_OUT_OF_RANGE", "TRAILING_DATA", "INDEX_OUT_OF_RANGE",
             "MALFORMED_FACE"},
            [] { return ReplaceFirst(GoodText(), "ascii", "binary_little_endian"); });
  files.Add("binary_called_text", {"MALFORMED_PLY", "INVALID_COUNT"},
            [] { return ReplaceFirst(GoodBinary(), "binary_little_endian", "ascii"); });
  files.Add("little_endian_called_big", {"COORDINATE_OUT_OF_RANGE", "INDEX_OUT_OF_RANGE"},
            [] { return ReplaceFirst(GoodBinary(), "little", "big"); });
  files.Add("head_only", {"NO_MESH"}, [] { return std::string("ply\nformat ascii 1.0\nend_header\n"); });
  files.Add("first_line_only", {"MALFORMED_PLY"}, [] { return std::string("ply\n"); });
  files.Add("rows_without_bytes", {"NO_MESH"},
            [] { return std::string("ply\nformat ascii 1.0\nelement nothing 999999999999999999\nend_header\n"); });
  files.Add("300_properties", {"MALFORMED_PLY"}, [] {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n";
    for (int i = 0; i < 300; ++i) text += "property float p" + std::to_string(i) + "\n";
    return text + "end_header\n";
  });
  files.Add("100_elements", {"MALFORMED_PLY"}, [] {
    std::string text = "ply\nformat ascii 1.0\n";
    for (int i = 0; i < 100; ++i) text += "element e" + std::to_string(i) + " 0\n";
    return text + "end_header\n";
  });
  files.Add("2m_comments", {"NO_MESH"}, [] {
    std::string text = "ply\nformat ascii 1.0\n";
    for (int i = 0; i < 2000000; ++i) text += "comment c\n";
    return text + "end_header\n";
  });
  files.Add("comment_of_32_mb", {"MALFORMED_PLY"},
            [] { return "ply\nformat ascii 1.0\ncomment " + std::string(size_t{32} << 20, 'c'); });
}

void AddBadBodies(PlyFiles& files) {
  const size_t vertex_7 = 7 * 12;
  const size_t face_5 = Mesh().vertices.size() * 12 + 5 * 13;
  using Float = std::numeric_limits<float>;
  files.AddBody("nan", {"COORDINATE_OUT_OF_RANGE"}, vertex_7, Raw(Float::quiet_NaN()));
  files.AddBody("signalling_nan", {"COORDINATE_OUT_OF_RANGE"}, vertex_7 + 4, Raw(uint32_t{0x7F800001}));
  files.AddBody("inf", {"COORDINATE_OUT_OF_RANGE"}, vertex_7 + 8, Raw(Float::infinity()));
  files.AddBody("minus_inf", {"COORDINATE_OUT_OF_RANGE"}, vertex_7, Raw(-Float::infinity()));
  files.AddBody("float_max", {"COORDINATE_OUT_OF_RANGE"}, vertex_7, Raw(Float::max()));
  for (const int count : {0, 1, 2}) {
    files.AddBody("face_of_" + std::to_string(count) + "_corners",
                  {"MALFORMED_FACE", "MALFORMED_PLY", "INDEX_OUT_OF_RANGE"}, face_5, Raw(static_cast<uint8_t>(count)));
  }
  files.AddBody("face_of_255_corners", {"INDEX_OUT_OF_RANGE", "MALFORMED_PLY"}, face_5, Raw(uint8_t{255}));
  for (const int32_t index : {static_cast<int32_t>(Mesh().vertices.size()), -1, 2147483647, -2147483647}) {
    files.AddBody("corner_is_" + std::to_string(index), {"INDEX_OUT_OF_RANGE"}, face_5 + 5, Raw(index));
  }
}

void AddBadRows(PlyFiles& files) {
  const auto text = [&](const char* name, std::vector<std::string_view> reasons, const char* row) {
    files.Add(std::string("row_") + name, std::move(reasons), [row] {
      return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
             std::string(row) + "\n";
    });
  };
  text("index_is_half", {"INDEX_OUT_OF_RANGE"}, "3 0 1 1.5");
  text("index_is_nan", {"INDEX_OUT_OF_RANGE"}, "3 0 1 nan");
  text("index_is_word", {"MALFORMED_PLY"}, "3 0 1 x");
  text("index_is_missing", {"MALFORMED_PLY"}, "3 0 1");
  text("index_is_1e99", {"INDEX_OUT_OF_RANGE"}, "3 0 1 1e99");
  text("index_with_comma", {"MALFORMED_PLY"}, "3 0 1, 2");
  text("length_is_minus_one", {"MALFORMED_PLY"}, "-1 0 1 2");
  text("length_is_4294967295", {"MALFORMED_PLY", "INDEX_OUT_OF_RANGE"}, "4294967295 0 1 2");
  text("length_is_half", {"MALFORMED_PLY"}, "2.5 0 1 2");
  text("length_is_two", {"MALFORMED_FACE"}, "2 0 1");
  text("degenerate", {"NO_TRIANGLES"}, "3 0 1 1");
}

void AddBombs(PlyFiles& files) {
  files.Add("binary_list_of_4_gib", {"MALFORMED_PLY", "INVALID_COUNT"}, [] {
    return "ply\nformat binary_little_endian 1.0\nelement junk 1\nproperty list uint double values\nend_header\n" +
           Raw(uint32_t{4294967295});
  });
  files.Add("binary_face_of_4_gib", {"MALFORMED_PLY", "INVALID_COUNT"}, [] {
    return "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int vertex_indices\nend_header\n" +
           Raw(uint32_t{4294967295});
  });
  files.Add("binary_list_of_negative_length", {"MALFORMED_PLY"}, [] {
    return "ply\nformat binary_little_endian 1.0\nelement junk 1\nproperty list int double values\nend_header\n" +
           Raw(int32_t{-8}) + Raw(0.0);
  });
  files.Add("polygon_bomb", {"SCAN_TOO_LARGE", "TOO_MANY_TRIANGLES"}, [] {
    // Polygons of 255 one-byte corners: 12 bytes of triangle for each.
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nelement face 100000\nproperty list uchar uchar vertex_indices\nend_header\n" +
        std::string(12, '\0');
    for (int i = 0; i < 100000; ++i) bytes += '\xFF' + std::string(255, '\0');
    return bytes;
  });
  files.Add("vertex_bomb", {"SCAN_TOO_LARGE", "TOO_MANY_VERTICES"}, [] {
    return "ply\nformat binary_little_endian 1.0\nelement vertex 7000000\nproperty char x\nproperty char y\n"
           "property char z\nend_header\n" +
           std::string(21000000, '\1');
  });
}

void AddBadGridsAndStrips(PlyFiles& files) {
  const auto grid = [&](const char* name, std::vector<std::string_view> reasons, const char* columns, const char* rows,
                        const char* places) {
    files.Add(std::string("grid_") + name, std::move(reasons), [=] {
      return "ply\nformat ascii 1.0\nobj_info " + std::string(columns) + "\nobj_info " + rows +
             "\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement range_grid 4\n"
             "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n" +
             places;
    });
  };
  const char* good = "1 0\n1 1\n1 2\n1 3\n";
  grid("without_columns", {"COUNT_MISMATCH"}, "other 2", "num_rows 2", good);
  grid("without_rows", {"COUNT_MISMATCH"}, "num_cols 2", "other 2", good);
  grid("too_wide", {"COUNT_MISMATCH"}, "num_cols 3", "num_rows 2", good);
  grid("of_no_columns", {"COUNT_MISMATCH"}, "num_cols 0", "num_rows 2", good);
  grid("of_negative_sides", {"COUNT_MISMATCH"}, "num_cols -2", "num_rows -2", good);
  grid("whose_size_overflows", {"COUNT_MISMATCH"}, "num_cols 4611686018427387905", "num_rows 4", good);
  grid("of_word_columns", {"COUNT_MISMATCH"}, "num_cols two", "num_rows 2", good);
  grid("with_two_samples_a_place", {"MALFORMED_PLY"}, "num_cols 2", "num_rows 2", "2 0 1\n1 1\n1 2\n1 3\n");
  grid("with_index_beyond", {"INDEX_OUT_OF_RANGE"}, "num_cols 2", "num_rows 2", "1 0\n1 1\n1 2\n1 4\n");
  grid("with_negative_index", {"INDEX_OUT_OF_RANGE"}, "num_cols 2", "num_rows 2", "1 0\n1 1\n1 2\n1 -1\n");
  grid("without_samples", {"NO_TRIANGLES"}, "num_cols 2", "num_rows 2", "0\n0\n0\n0\n");
  grid("cut", {"MALFORMED_PLY", "INVALID_COUNT"}, "num_cols 2", "num_rows 2", "1 0\n1 1\n1 2\n");
  const auto strip = [&](const char* name, std::vector<std::string_view> reasons, const char* row) {
    files.Add(std::string("strip_") + name, std::move(reasons), [row] {
      return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
             std::string(row) + "\n";
    });
  };
  strip("with_index_beyond", {"INDEX_OUT_OF_RANGE"}, "3 0 1 3");
  strip("with_minus_two", {"INDEX_OUT_OF_RANGE"}, "4 0 1 -2 2");
  strip("cut", {"MALFORMED_PLY"}, "5 0 1 2");
  strip("of_two", {"NO_TRIANGLES"}, "2 0 1");
  strip("that_only_steers", {"NO_TRIANGLES"}, "6 0 0 1 1 2 2");
  strip("of_negative_length", {"MALFORMED_PLY"}, "-3 0 1 2");
}

}  // namespace

std::vector<BadFile> MakeBadPlyFiles() {
  PlyFiles files;
  AddTruncations(files);
  AddBadHeads(files);
  AddBadBodies(files);
  AddBadRows(files);
  AddBombs(files);
  AddBadGridsAndStrips(files);
  return files.Take();
}

}  // namespace fitroom::testing
