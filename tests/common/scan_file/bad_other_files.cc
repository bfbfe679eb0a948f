#include <random>
#include <string>
#include <utility>

#include "common/codec/zstd.h"
#include "common/scan_file/ase_writer.h"
#include "common/scan_file/obj_writer.h"
#include "tests/common/scan_file/bad_files.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom::testing {
namespace {

const std::string& GoodAse() {
  static const std::string text = FormatAse(MakeSphere(12, 17), MakeTexturedContent(MakeSphere(12, 17)));
  return text;
}

std::string RandomBytes(size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string bytes;
  for (size_t i = 0; i < size; ++i) bytes += static_cast<char>(random());
  return bytes;
}

}  // namespace

std::vector<BadFile> MakeBadObjFiles() {
  std::vector<BadFile> files;
  const auto add = [&](const std::string& name, std::vector<std::string_view> reasons, std::string text) {
    files.push_back({"obj_" + name, std::move(reasons), [text] { return text; }});
  };
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* bad : {"nan", "inf", "-inf", "1e99", "1e400", "1,5", "abc", "--1", "1.#QNAN", "0x1", "."}) {
    add(std::string("coordinate_is_") + bad, {"MALFORMED_NUMBER", "COORDINATE_OUT_OF_RANGE"},
        triangle + "v 1 " + bad + " 0\nf 1 2 3\n");
  }
  for (const char* bad : {"4", "0", "-4", "2147483648", "4294967297", "99999999999999999999", "x", "1.5", "1/", "/1",
                          "1//", "1/5", "1e0", "+1"}) {
    add(std::string("corner_is_") + bad, {"INDEX_OUT_OF_RANGE"}, triangle + "f 1 2 " + bad + "\n");
  }
  add("vertex_of_two", {"MALFORMED_NUMBER"}, triangle + "v 1 2\nf 1 2 3\n");
  add("vertex_of_none", {"MALFORMED_NUMBER"}, triangle + "v\nf 1 2 3\n");
  add("texture_is_nan", {"COORDINATE_OUT_OF_RANGE"}, triangle + "vt nan 0\nf 1 2 3\n");
  add("texture_is_word", {"MALFORMED_NUMBER"}, triangle + "vt a b\nf 1 2 3\n");
  add("face_of_two", {"MALFORMED_FACE"}, triangle + "f 1 2\n");
  add("face_of_none", {"MALFORMED_FACE"}, triangle + "f\n");
  add("vertices_only", {"NO_TRIANGLES"}, triangle);
  add("faces_only", {"INDEX_OUT_OF_RANGE"}, "f 1 2 3\n");
  add("comments_only", {"UNKNOWN_FORMAT", "NO_MESH"}, "# nothing\n# at all\n");
  add("words_only", {"NO_MESH"}, "o nothing\ng at\nusemtl all\n");
  add("degenerate", {"NO_TRIANGLES"}, triangle + "f 1 1 2\n");
  add("last_line_open", {"TRUNCATED_FILE"}, triangle + "f 1 2 3");
  add("cut_in_a_vertex", {"TRUNCATED_FILE"}, triangle + "f 1 2 3\nv 0.1 0.2 0.");
  add("nul_bytes", {"MALFORMED_OBJ"}, triangle + std::string(1000, '\0') + "\nf 1 2 3\n");
  add("noise", {"MALFORMED_OBJ"}, triangle + "f 1 2 3\n%&/()=\n");
  std::string polygon = triangle + "f";
  for (int i = 0; i < 70000; ++i) polygon += " 1";
  add("polygon_of_70000_corners", {"MALFORMED_FACE"}, polygon + "\n");
  std::string objects = triangle;
  for (int i = 0; i < 20000; ++i) objects += "o a\nf 1 2 3\n";
  add("20000_objects", {"TOO_MANY_OBJECTS"}, objects);
  files.push_back({"obj_line_of_32_mb", {"TRUNCATED_FILE", "MALFORMED_NUMBER"}, [triangle] {
                     return triangle + "f 1 2 3\nv 0 0 0" + std::string(size_t{32} << 20, '0');
                   }});
  files.push_back({"obj_polygon_bomb", {"SCAN_TOO_LARGE"}, [triangle] {
                     std::string text = triangle;
                     std::string line = "f";
                     for (int i = 0; i < 60000; ++i) line += " 1";
                     for (int i = 0; i < 250; ++i) text += line + "\n";
                     return text;
                   }});
  const std::string good = FormatObj(MakeSphere(12, 17));
  for (size_t size = 1000; size < good.size(); size += 1024) {
    files.push_back({"obj_cut_at_byte_" + std::to_string(size),
                     {"TRUNCATED_FILE", "MALFORMED_NUMBER", "MALFORMED_FACE", "NO_TRIANGLES"},
                     [good, size] { return good.substr(0, size); }});
  }
  return files;
}

std::vector<BadFile> MakeForeignFiles() {
  std::vector<BadFile> files;
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"foreign_" + name, {"UNKNOWN_FORMAT", "EMPTY_FILE"}, [bytes] { return bytes; }});
  };
  add("empty", "");
  add("one_byte", "x");
  add("blanks", " \t\r\n  \n");
  add("text", "Dear shop,\nplease find my scan enclosed.\n");
  add("png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) + RandomBytes(4000, 1));
  add("jpeg", "\xFF\xD8\xFF\xE0" + RandomBytes(4000, 2));
  add("webp", "RIFF\x10\x20\x30\x40WEBPVP8 " + RandomBytes(4000, 3));
  add("zip", "PK\x03\x04" + RandomBytes(4000, 4));
  add("gzip", "\x1F\x8B\x08" + RandomBytes(4000, 5));
  add("pdf", "%PDF-1.4\n" + RandomBytes(4000, 6));
  add("elf",
      "\x7F"
      "ELF\x02\x01\x01" +
          RandomBytes(4000, 7));
  add("html", "<!DOCTYPE html>\n<html><body>v 1 2 3</body></html>\n");
  add("json", "{\"vertices\": [[0, 0, 0]]}\n");
  add("xml", "<?xml version=\"1.0\"?>\n<mesh/>\n");
  add("glb", std::string("glTF\2\0\0\0", 8) + RandomBytes(4000, 8));
  add("stl_text", "solid body\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid\n");
  add("stl_binary", std::string(84, '\1') + RandomBytes(4000, 9));
  add("zeros", std::string(size_t{1} << 20, '\0'));
  add("ones", std::string(size_t{1} << 20, '\xFF').replace(0, 1, "\xFD"));
  add("random", "\x80" + RandomBytes(size_t{1} << 20, 10));
  add("plywood", "plywood is made of veneers\n");
  add("csv", "1.0,2.0,3.0\n4.0,5.0,6.0\n");
  add("star", "*");
  add("utf8_mark_only", "\xEF\xBB\xBF");
  return files;
}

std::vector<BadFile> MakeBadPackedFiles() {
  std::vector<BadFile> files;
  const auto add = [&](const std::string& name, std::vector<std::string_view> reasons,
                       std::function<std::string()> make) {
    files.push_back({name, std::move(reasons), std::move(make)});
  };
  for (const bool big_endian : {false, true}) {
    const std::string name = big_endian ? "utf16_be_" : "utf16_le_";
    add(name + "of_odd_size", {"ODD_UTF16"}, [=] { return ToUtf16(GoodAse(), big_endian) + "\n"; });
    add(name + "cut_within_a_character", {"ODD_UTF16"}, [=] { return ToUtf16(GoodAse(), big_endian).substr(0, 5001); });
    add(name + "cut", {"UNBALANCED_BLOCK"}, [=] { return ToUtf16(GoodAse(), big_endian).substr(0, 50000); });
    add(name + "mark_only", {"UNKNOWN_FORMAT"}, [=] { return ToUtf16("", big_endian); });
    add(name + "swapped", {"UNKNOWN_FORMAT"},
        [=] { return ToUtf16("", big_endian) + ToUtf16(GoodAse(), !big_endian).substr(2); });
    add(name + "of_surrogates", {"UNKNOWN_FORMAT"}, [=] {
      std::string bytes = ToUtf16("", big_endian);
      for (int i = 0; i < 100000; ++i) bytes += big_endian ? "\xD8\x01" : "\x01\xD8";
      return bytes;
    });
  }
  add("utf32", {"UNKNOWN_FORMAT", "MALFORMED_ASE", "ODD_UTF16"}, [] {
    std::string bytes("\xFF\xFE\0\0", 4);
    for (const char c : GoodAse()) bytes += std::string(1, c) + std::string(3, '\0');
    return bytes;
  });

  const std::string good = ZstdCompress(GoodAse());
  for (size_t size = 4; size < good.size(); size += 1024) {
    add("zstd_cut_at_byte_" + std::to_string(size), {"ZSTD_DAMAGED"}, [=] { return good.substr(0, size); });
  }
  add("zstd_a_byte_short", {"ZSTD_DAMAGED"}, [=] { return good.substr(0, good.size() - 1); });
  add("zstd_with_trailing_byte", {"ZSTD_DAMAGED"}, [=] { return good + "x"; });
  add("zstd_with_second_frame", {"ZSTD_DAMAGED"}, [=] { return good + good; });
  add("zstd_of_random_bytes", {"ZSTD_DAMAGED"}, [=] { return good.substr(0, 4) + RandomBytes(4000, 11); });
  add("zstd_with_flipped_bit", {"ZSTD_DAMAGED"}, [=] {
    std::string bytes = good;
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    return bytes;
  });
  add("zstd_of_nothing", {"EMPTY_FILE"}, [] { return ZstdCompress(""); });
  add("zstd_of_a_picture", {"UNKNOWN_FORMAT"}, [] { return ZstdCompress("\x89PNG\r\n" + RandomBytes(4000, 12)); });
  add("zstd_in_zstd", {"UNKNOWN_FORMAT"}, [=] { return ZstdCompress(good); });
  add("zstd_of_a_cut_scan", {"UNBALANCED_BLOCK"}, [] { return ZstdCompress(GoodAse().substr(0, 50000)); });
  add("zstd_bomb_of_128_mib", {"ZSTD_TOO_LARGE"}, [] { return ZstdCompress(std::string(size_t{128} << 20, '\0'), 1); });
  add("zstd_bomb_of_blanks", {"ZSTD_TOO_LARGE"},
      [] { return ZstdCompress("*3DSMAX_ASCIIEXPORT 200\n" + std::string(size_t{64} << 20, ' '), 3); });
  // Heads made by hand: magic, descriptor, window or content size, then nothing true.
  add("zstd_declares_16_eib", {"ZSTD_TOO_LARGE"},
      [] { return std::string("\x28\xB5\x2F\xFD\xE0\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x0F", 13) + std::string(100, '\0'); });
  add("zstd_declares_1_gib", {"ZSTD_TOO_LARGE"},
      [] { return std::string("\x28\xB5\x2F\xFD\xA0\x00\x00\x00\x40", 9) + std::string(100, '\0'); });
  add("zstd_window_of_2_gib", {"ZSTD_DAMAGED"},
      [] { return std::string("\x28\xB5\x2F\xFD\x00\xA8", 6) + std::string("\x01\x00\x00", 3); });
  add("zstd_magic_only", {"ZSTD_DAMAGED"}, [] { return std::string("\x28\xB5\x2F\xFD"); });
  return files;
}

}  // namespace fitroom::testing
