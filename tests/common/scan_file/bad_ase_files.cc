#include <string>
#include <utility>

#include "common/scan_file/ase_writer.h"
#include "tests/common/scan_file/bad_files.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom::testing {
namespace {

const TriangleMesh& Mesh() {
  static const TriangleMesh mesh = MakeSphere(12, 17);
  return mesh;
}

const std::string& GoodText() {
  static const std::string text = FormatAse(Mesh(), MakeTexturedContent(Mesh()));
  return text;
}

// Returns the line of the good file that begins with `start` after its tabs, without its end.
std::string Line(const std::string& start) {
  const size_t at = GoodText().find("\t" + start);
  const size_t end = GoodText().find("\r\n", at);
  return GoodText().substr(at + 1, end - at - 1);
}

class AseFiles {
 public:
  void Add(const std::string& name, std::vector<std::string_view> reasons, std::function<std::string()> make) {
    files_.push_back({"ase_" + name, std::move(reasons), std::move(make)});
  }
  // A good file with one line replaced.
  void AddLine(const std::string& name, std::vector<std::string_view> reasons, const std::string& start,
               const std::string& line) {
    Add(name, std::move(reasons), [start, line] { return ReplaceFirst(GoodText(), Line(start), line); });
  }
  std::vector<BadFile> Take() { return std::move(files_); }

 private:
  std::vector<BadFile> files_;
};

void AddTruncations(AseFiles& files) {
  for (size_t size = 1024; size < GoodText().size(); size += 1024) {
    files.Add("cut_at_" + std::to_string(size / 1024) + "_kib",
              {"UNBALANCED_BLOCK", "NO_MESH", "MALFORMED_ASE", "MALFORMED_NUMBER", "INVALID_COUNT", "COUNT_MISMATCH"},
              [size] { return GoodText().substr(0, size); });
  }
  for (const size_t missing : {1U, 2U, 3U, 4U, 10U, 20U}) {
    if (missing < 3) continue;  // The last line end may go.
    files.Add("cut_" + std::to_string(missing) + "_bytes_short", {"UNBALANCED_BLOCK"},
              [missing] { return GoodText().substr(0, GoodText().size() - missing); });
  }
}

void AddLyingCounts(AseFiles& files) {
  const std::pair<const char*, const char*> lies[] = {{"2e8", "200000000"}, {"uint32_max", "4294967295"},
                                                      {"minus_one", "-1"},  {"1e99", "1e99"},
                                                      {"nan", "NaN"},       {"nothing", ""},
                                                      {"hex", "0x10"},      {"fraction", "1.5"},
                                                      {"zero", "0"},        {"2_to_64", "18446744073709551616"},
                                                      {"one", "1"},         {"one_more", ""},
                                                      {"one_less", ""}};
  for (const char* keyword : {"NUMVERTEX", "NUMFACES", "NUMTVERTEX", "NUMTVFACES"}) {
    const std::string line = Line(std::string("*MESH_") + keyword);
    const int count = std::stoi(line.substr(line.find(' ')));
    for (const auto& [name, text] : lies) {
      std::string lie = text;
      if (std::string_view(name) == "one_more") lie = std::to_string(count + 1);
      if (std::string_view(name) == "one_less") lie = std::to_string(count - 1);
      files.AddLine(std::string("count_of_") + keyword + "_is_" + name,
                    {"INVALID_COUNT", "INDEX_OUT_OF_RANGE", "COUNT_MISMATCH"}, std::string("*MESH_") + keyword,
                    std::string("*MESH_") + keyword + " " + lie);
    }
  }
}

void AddBadNumbers(AseFiles& files) {
  const std::string vertex = "*MESH_VERTEX    7\t";
  const std::pair<const char*, const char*> bad[] = {
      {"nan", "nan"},          {"minus_nan", "-nan"},    {"inf", "inf"},          {"minus_inf", "-inf"},
      {"1e99", "1e99"},        {"1e400", "1e400"},       {"1e10", "10000000000"}, {"qnan", "1.#QNAN"},
      {"ind", "-1.#IND"},      {"comma", "1,5"},         {"word", "abc"},         {"two_signs", "--1"},
      {"open_exponent", "1e"}, {"hex", "0x1p3"},         {"two_points", "1.2.3"}, {"point", "."},
      {"sign", "-"},           {"infinity", "Infinity"}, {"brace", "{"},          {"quote", "\"1\""}};
  for (const auto& [name, text] : bad) {
    files.AddLine(std::string("coordinate_is_") + name, {"MALFORMED_NUMBER", "COORDINATE_OUT_OF_RANGE"}, vertex,
                  vertex + "1.0\t" + text + "\t2.0");
  }
  files.AddLine("coordinate_holds_nul", {"MALFORMED_NUMBER"}, vertex, vertex + std::string("1.0\t1\0.0\t2.0", 12));
  files.AddLine("two_coordinates", {"MALFORMED_NUMBER"}, vertex, vertex + "1.0\t2.0");
  files.AddLine("no_coordinates", {"MALFORMED_NUMBER"}, vertex, "*MESH_VERTEX    7");
  files.AddLine("vertex_without_number", {"MALFORMED_NUMBER", "INDEX_OUT_OF_RANGE"}, vertex, "*MESH_VERTEX \t");
  files.Add("coordinate_of_a_million_digits", {"COORDINATE_OUT_OF_RANGE"},
            [vertex] { return ReplaceFirst(GoodText(), Line(vertex), vertex + std::string(1000000, '9') + "\t0\t0"); });
  files.AddLine("texture_coordinate_is_nan", {"COORDINATE_OUT_OF_RANGE"}, "*MESH_TVERT 3\t",
                "*MESH_TVERT 3\tnan\t0\t0");
  files.AddLine("texture_coordinate_with_comma", {"MALFORMED_NUMBER"}, "*MESH_TVERT 3\t", "*MESH_TVERT 3\t0,5\t0,5\t0");
  files.AddLine("texture_coordinate_is_missing", {"MALFORMED_NUMBER"}, "*MESH_TVERT 3\t", "*MESH_TVERT 3");
}

void AddBadIndices(AseFiles& files) {
  const std::string face = "*MESH_FACE    5:";
  const std::string vertex_count = std::to_string(Mesh().vertices.size());
  const std::pair<const char*, std::string> corners[] = {{"the_vertex_count", vertex_count},
                                                         {"minus_one", "-1"},
                                                         {"uint32_max", "4294967295"},
                                                         {"int64_max", "9223372036854775807"},
                                                         {"2_to_64", "18446744073709551616"},
                                                         {"nothing", ""},
                                                         {"a_word", "x"},
                                                         {"fraction", "1.5"},
                                                         {"1e3", "1e3"}};
  for (const auto& [name, text] : corners) {
    files.AddLine(std::string("corner_is_") + name, {"INDEX_OUT_OF_RANGE", "MALFORMED_NUMBER", "MALFORMED_ASE"}, face,
                  face + "    A:    0 B:    " + text + " C:    2 AB:    1");
  }
  files.AddLine("face_of_two_corners", {"MALFORMED_ASE"}, face, face + "    A:    0 B:    1");
  files.AddLine("face_with_labels_swapped", {"MALFORMED_ASE"}, face, face + "    B:    0 A:    1 C:    2");
  files.AddLine("face_without_colon", {"MALFORMED_ASE"}, face, "*MESH_FACE    5     A:    0 B:    1 C:    2");
  files.AddLine("face_given_twice", {"DUPLICATE_INDEX"}, face, "*MESH_FACE    4:    A:    0 B:    1 C:    2");
  files.AddLine("face_beyond_count", {"INDEX_OUT_OF_RANGE"}, face, "*MESH_FACE 9999:    A:    0 B:    1 C:    2");
  files.AddLine("face_missing", {"COUNT_MISMATCH"}, face, "");
  files.AddLine("vertex_given_twice", {"DUPLICATE_INDEX"}, "*MESH_VERTEX    7\t", "*MESH_VERTEX    6\t0\t0\t0");
  files.AddLine("vertex_beyond_count", {"INDEX_OUT_OF_RANGE"}, "*MESH_VERTEX    7\t", "*MESH_VERTEX 9999\t0\t0\t0");
  files.AddLine("vertex_of_negative_number", {"INDEX_OUT_OF_RANGE"}, "*MESH_VERTEX    7\t", "*MESH_VERTEX -7\t0\t0\t0");
  files.AddLine("vertex_missing", {"COUNT_MISMATCH"}, "*MESH_VERTEX    7\t", "");
  files.AddLine("texture_vertex_given_twice", {"DUPLICATE_INDEX"}, "*MESH_TVERT 3\t", "*MESH_TVERT 2\t0\t0\t0");
  files.AddLine("texture_vertex_missing", {"COUNT_MISMATCH"}, "*MESH_TVERT 3\t", "");
  files.AddLine("texture_vertex_beyond_count", {"INDEX_OUT_OF_RANGE"}, "*MESH_TVERT 3\t", "*MESH_TVERT 999\t0\t0\t0");
  files.AddLine("texture_face_given_twice", {"DUPLICATE_INDEX"}, "*MESH_TFACE 3\t", "*MESH_TFACE 2\t0\t1\t2");
  files.AddLine("texture_face_missing", {"COUNT_MISMATCH"}, "*MESH_TFACE 3\t", "");
  files.AddLine("texture_corner_beyond_count", {"INDEX_OUT_OF_RANGE"}, "*MESH_TFACE 3\t", "*MESH_TFACE 3\t0\t1\t999");
  files.AddLine("texture_corner_missing", {"MALFORMED_NUMBER"}, "*MESH_TFACE 3\t", "*MESH_TFACE 3\t0\t1");
  files.Add("all_faces_degenerate", {"NO_TRIANGLES"}, [] {
    TriangleMesh mesh;
    mesh.vertices.assign(3, Eigen::Vector3d::Zero());
    mesh.triangles.assign(5, Eigen::Vector3i(0, 1, 1));
    return FormatAse(mesh, {});
  });
}

void AddBadBlocks(AseFiles& files) {
  const auto change = [&](const char* name, std::vector<std::string_view> reasons, const char* from, const char* to) {
    files.Add(name, std::move(reasons), [from, to] { return ReplaceFirst(GoodText(), from, to); });
  };
  change("vertex_list_never_closed", {"UNBALANCED_BLOCK", "COUNT_MISMATCH"}, "\t\t}\r\n\t\t*MESH_FACE_LIST",
         "\t\t*MESH_FACE_LIST");
  change("face_list_never_closed", {"UNBALANCED_BLOCK", "COUNT_MISMATCH"}, "\t\t}\r\n\t\t*MESH_NUMTVERTEX",
         "\t\t*MESH_NUMTVERTEX");
  change("normals_never_closed", {"UNBALANCED_BLOCK"}, "\t\t}\r\n\t}\r\n\t*PROP", "\t}\r\n\t*PROP");
  change("mesh_never_closed", {"UNBALANCED_BLOCK"}, "\t}\r\n\t*PROP", "\t*PROP");
  change("node_tm_never_closed", {"UNBALANCED_BLOCK"}, "\t}\r\n\t*MESH {", "\t*MESH {");
  change("scene_never_closed", {"UNBALANCED_BLOCK"}, "}\r\n*MATERIAL_LIST", "*MATERIAL_LIST");
  change("brace_too_many", {"UNBALANCED_BLOCK"}, "*GEOMOBJECT", "}\r\n*GEOMOBJECT");
  change("object_without_block", {"MALFORMED_ASE"}, "*GEOMOBJECT {", "*GEOMOBJECT");
  change("mesh_without_block", {"MALFORMED_ASE"}, "*MESH {", "*MESH ");
  change("vertex_list_without_block", {"MALFORMED_ASE"}, "*MESH_VERTEX_LIST {", "*MESH_VERTEX_LIST");
  change("faces_in_the_vertex_list", {"COUNT_MISMATCH", "MALFORMED_ASE"}, "*MESH_VERTEX_LIST", "*MESH_FACE_LIST");
  change("vertices_without_count", {"MALFORMED_ASE"}, "*MESH_NUMVERTEX", "*MESH_NUMNOTHING");
  change("faces_without_count", {"MALFORMED_ASE"}, "*MESH_NUMFACES", "*MESH_NUMNOTHING");
  change("count_given_twice", {"DUPLICATE_COUNT"}, "*MESH_NUMFACES", "*MESH_NUMVERTEX");
  change("vertex_list_missing", {"COUNT_MISMATCH"}, "*MESH_VERTEX_LIST", "*MESH_OTHER_LIST");
  change("face_list_missing", {"COUNT_MISMATCH"}, "*MESH_FACE_LIST", "*MESH_OTHER_LIST");
  change("texture_list_missing", {"COUNT_MISMATCH"}, "*MESH_TVERTLIST", "*MESH_OTHER_LIST");
  change("face_list_before_its_count", {"MALFORMED_ASE"}, "*MESH_NUMFACES", "*MESH_FACE_LIST {\r\n}\r\n*MESH_NUMFACES");
  change("line_of_noise", {"MALFORMED_ASE"}, "\t*PROP_MOTIONBLUR", "noise\r\n\t*PROP_MOTIONBLUR");
  change("line_of_noise_among_vertices", {"MALFORMED_ASE"}, "\t\t\t*MESH_VERTEX    9",
         "noise\r\n\t\t\t*MESH_VERTEX    9");
  files.Add("two_vertex_lists", {"MALFORMED_ASE"}, [] {
    const size_t start = GoodText().find("\t\t*MESH_VERTEX_LIST");
    const size_t end = GoodText().find("\t\t*MESH_FACE_LIST");
    return std::string(GoodText()).insert(end, GoodText().substr(start, end - start));
  });
  files.Add("nul_byte_between_objects", {"MALFORMED_ASE"},
            [] { return ReplaceFirst(GoodText(), "*GEOMOBJECT", std::string("\0*GEOMOBJECT", 12)); });
  files.Add("second_half_is_nul", {"UNBALANCED_BLOCK", "MALFORMED_ASE"}, [] {
    std::string text = GoodText();
    return text.replace(text.size() / 2, text.size(), text.size() - text.size() / 2, '\0');
  });
  files.Add("cr_only_and_cut", {"UNBALANCED_BLOCK"}, [] {
    const std::string text = Replace(GoodText(), "\r\n", "\r");
    return text.substr(0, text.size() / 2);
  });
}

void AddBombs(AseFiles& files) {
  const std::string head = "*3DSMAX_ASCIIEXPORT\t200\r\n";
  const auto repeat = [](const std::string& text, size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (size_t i = 0; i < count; ++i) all += text;
    return all;
  };
  const auto add = [&](const char* name, std::vector<std::string_view> reasons, std::string front, std::string text,
                       size_t count, std::string back) {
    files.Add(name, std::move(reasons), [=] { return head + front + repeat(text, count) + back; });
  };
  add("200k_nested_blocks_never_closed", {"UNBALANCED_BLOCK"}, "", "*SCENE {\n", 200000, "");
  add("200k_nested_blocks_closed", {"NO_MESH"}, repeat("*SCENE {\n", 200000), "}\n", 200000, "");
  add("200k_nested_groups_never_closed", {"UNBALANCED_BLOCK"}, "", "*GROUP \"g\" {\n", 200000, "");
  add("200k_nested_groups_closed", {"NO_MESH"}, repeat("*GROUP \"g\" {\n", 200000), "}\n", 200000, "");
  add("200k_nested_objects", {"UNBALANCED_BLOCK", "MALFORMED_ASE"}, "", "*GEOMOBJECT {\n", 200000, "");
  add("200k_nested_meshes", {"UNBALANCED_BLOCK"}, "*GEOMOBJECT {\n", "*MESH {\n", 200000, "");
  add("200k_closing_braces", {"UNBALANCED_BLOCK"}, "", "}\n", 200000, "");
  add("200k_material_lists", {"NO_MESH"}, "", "*MATERIAL_LIST {\n}\n", 200000, "");
  add("200k_empty_objects", {"NO_MESH"}, "", "*GEOMOBJECT {\n}\n", 200000, "");
  add("200k_empty_meshes", {"TOO_MANY_OBJECTS"}, "", "*GEOMOBJECT {\n*MESH {\n}\n}\n", 200000, "");
  add("4m_opening_braces_in_a_line", {"UNBALANCED_BLOCK"}, "*SCENE ", "{", 4000000, "");
  add("4m_quotes_in_a_line", {"NO_MESH"}, "*SCENE ", "\"", 4000000, "\n");
  add("4m_quotes_in_a_block", {"UNBALANCED_BLOCK"}, "*SCENE {", "\"\n", 2000000, "");
  add("4m_stars", {"NO_MESH", "MALFORMED_ASE"}, "", "*", 4000000, "");
  add("line_of_32_mb", {"NO_MESH"}, "*COMMENT \"", "lorem ipsum ", 2796202, "\"\r\n");
  add("line_of_32_mb_without_quote", {"NO_MESH"}, "*COMMENT ", "lorem ipsum ", 2796202, "\r\n");
  add("line_of_32_mb_of_keywords", {"NO_MESH"}, "", "*SCENE ", 4793490, "\r\n");
  add("line_of_32_mb_of_digits", {"INVALID_COUNT"}, "*GEOMOBJECT {\n*MESH {\n*MESH_NUMVERTEX ", "7", 33554432,
      "\n}\n}\n");
  add("blanks_of_32_mb", {"NO_MESH"}, "", "    \t\r\n", 4793490, "");
  files.Add("head_only", {"NO_MESH"}, [=] { return head; });
  files.Add("shapes_only", {"NO_MESH"}, [=] { return head + "*SHAPEOBJECT {\n*NODE_NAME \"line\"\n}\n"; });
  files.Add("points_only", {"NO_TRIANGLES"}, [=] {
    return head +
           "*GEOMOBJECT {\n*MESH {\n*MESH_NUMVERTEX 1\n*MESH_NUMFACES 0\n*MESH_VERTEX_LIST {\n"
           "*MESH_VERTEX 0\t0\t0\t0\n}\n}\n}\n";
  });
  files.Add("faces_without_vertices", {"INDEX_OUT_OF_RANGE"}, [=] {
    return head +
           "*GEOMOBJECT {\n*MESH {\n*MESH_NUMVERTEX 0\n*MESH_NUMFACES 1\n*MESH_FACE_LIST {\n"
           "*MESH_FACE 0: A: 0 B: 1 C: 2\n}\n}\n}\n";
  });
  files.Add("second_object_cut", {"UNBALANCED_BLOCK"}, [=] {
    const std::string text = GoodText() + GoodText().substr(GoodText().find("*GEOMOBJECT"));
    return text.substr(0, text.size() - 2000);
  });
}

}  // namespace

std::vector<BadFile> MakeBadAseFiles() {
  AseFiles files;
  AddTruncations(files);
  AddLyingCounts(files);
  AddBadNumbers(files);
  AddBadIndices(files);
  AddBadBlocks(files);
  AddBombs(files);
  return files.Take();
}

}  // namespace fitroom::testing
