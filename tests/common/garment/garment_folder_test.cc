#include "common/garment/garment_folder.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "common/image/encode.h"
#include "tests/support/sample_garment.h"
#include "tests/support/temporary_folder.h"

namespace fitroom {
namespace {

std::vector<GarmentFile> SampleFiles(int side) {
  const std::string picture = EncodePng(MakeImage(side, side, 3));
  std::vector<GarmentFile> files;
  for (const char* name :
       {"front.png", "front_mask.png", "front_texture.png", "back.png", "back_mask.png", "back_texture.png"}) {
    files.push_back({name, picture});
  }
  return files;
}

TEST(GarmentFolder, IsReadAsItWasWritten) {
  const testing::TemporaryFolder folder;
  const Garment garment = testing::MakeSampleTShirt();
  const Status written = WriteGarmentFolder(folder.path() / "a" / "b", garment, SampleFiles(800));
  ASSERT_TRUE(written.ok()) << written.ToString();
  const Result<Garment> read = ReadGarmentFolder(folder.path() / "a" / "b");
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(read->front.outline, garment.front.outline);
  const Result<Image> texture = ReadGarmentTexture(folder.path() / "a" / "b", read->front);
  ASSERT_TRUE(texture.ok()) << texture.status().ToString();
  EXPECT_EQ(texture->channels, 3);
  const Result<Image> mask = ReadGarmentMask(folder.path() / "a" / "b", *read->back);
  ASSERT_TRUE(mask.ok()) << mask.status().ToString();
  EXPECT_EQ(mask->channels, 1);
}

TEST(GarmentFolder, SaysWhatIsMissing) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(ReadGarmentFolder(folder.path()).status().reason(), "GARMENT_NOT_FOUND");
  const Garment garment = testing::MakeSampleTShirt();
  std::vector<GarmentFile> files = SampleFiles(800);
  files.pop_back();
  EXPECT_EQ(WriteGarmentFolder(folder.path(), garment, files).reason(), "GARMENT_FILE_MISSING");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "garment.json"));
  ASSERT_TRUE(WriteGarmentFolder(folder.path(), garment, SampleFiles(800)).ok());
  std::filesystem::remove(folder.path() / "back_mask.png");
  EXPECT_EQ(ReadGarmentFolder(folder.path()).status().reason(), "GARMENT_FILE_MISSING");
}

TEST(GarmentFolder, ATextureOfAnotherSizeIsRefused) {
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(WriteGarmentFolder(folder.path(), testing::MakeSampleTShirt(), SampleFiles(799)).ok());
  const Result<Garment> garment = ReadGarmentFolder(folder.path());
  ASSERT_TRUE(garment.ok());
  EXPECT_EQ(ReadGarmentTexture(folder.path(), garment->front).status().reason(), "IMAGE_SIZE");
}

TEST(GarmentFolder, NeverWritesOutsideItself) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"../x", "/tmp/x", ".hidden", "a/b", "", "garment.json"}) {
    std::vector<GarmentFile> files = SampleFiles(800);
    files.push_back({name, "x"});
    EXPECT_EQ(WriteGarmentFolder(folder.path(), testing::MakeSampleTShirt(), files).reason(), "GARMENT_FILE_NAME")
        << name;
  }
}

}  // namespace
}  // namespace fitroom
