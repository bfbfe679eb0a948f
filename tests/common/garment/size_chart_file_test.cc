#include "common/garment/size_chart_file.h"

#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/file.h"
#include "common/garment/validate.h"
#include "tests/support/sample_garment.h"
#include "tests/support/temporary_folder.h"

namespace fitroom {
namespace {

using ::testing::HasSubstr;

constexpr char kTable[] =
    "size,chest_width,sleeve_length,body_bust\n"
    "S,46,20.5,84\n"
    "M,49,21,90\n"
    "L,52.5,,96\n";

void ExpectTheTable(const Result<SizeChart>& chart) {
  ASSERT_TRUE(chart.ok()) << chart.status().ToString();
  ASSERT_EQ(chart->sizes.size(), 3u);
  EXPECT_EQ(chart->photographed_size, "M");
  EXPECT_EQ(chart->sizes[0].name, "S");
  ASSERT_EQ(chart->sizes[0].measures.size(), 2u);
  EXPECT_EQ(chart->sizes[0].measures[0], (GarmentMeasure{"chest_width", 0.46, Provenance::kStated}));
  EXPECT_EQ(chart->sizes[0].measures[1], (GarmentMeasure{"sleeve_length", 0.205, Provenance::kStated}));
  ASSERT_EQ(chart->sizes[2].measures.size(), 1u);
  EXPECT_EQ(chart->sizes[2].measures[0].value, 0.525);
  ASSERT_EQ(chart->sizes[1].body.size(), 1u);
  EXPECT_EQ(chart->sizes[1].body[0], (GarmentMeasure{"bust", 0.9, Provenance::kStated}));
}

TEST(SizeChartFile, ReadsATable) { ExpectTheTable(SizeChartFromText(kTable, GarmentKind::kTShirt, "M")); }

// The same chart as spreadsheets of other countries and other decades save it.
TEST(SizeChartFile, ReadsWhatSpreadsheetsSave) {
  const std::string text = kTable;
  ExpectTheTable(SizeChartFromText("\xef\xbb\xbf# Our shirt\r\n\r\n" + text, GarmentKind::kTShirt, "M"));
  std::string european =
      "Size;Chest width (cm);Sleeve-length;body_bust\r\nS;46,0;20,5;84\r\n\"M\";49;21;90\r\nL; 52,5 ;;96";
  ExpectTheTable(SizeChartFromText(european, GarmentKind::kTShirt, "M"));
  std::string old = text;
  for (char& c : old) c = c == '\n' ? '\r' : c == ',' ? '\t' : c;
  ExpectTheTable(SizeChartFromText(old, GarmentKind::kTShirt, "M"));
  ExpectTheTable(SizeChartFromText(text + ",,,\n   \n", GarmentKind::kTShirt, "M"));
}

TEST(SizeChartFile, ReadsJson) {
  const std::string json = R"(
    {"photographed_size": "S",
     "sizes": [{"name": "S", "measures_cm": {"chest_width": 46, "sleeve_length": 20.5}, "body_cm": {"bust": 84}},
               {"name": "M", "measures_cm": {"chest_width": 49, "sleeve_length": 21}, "body_cm": {"bust": 90}},
               {"name": "L", "measures_cm": {"chest_width": 52.5}, "body_cm": {"bust": 96}}]})";
  ExpectTheTable(SizeChartFromText(json, GarmentKind::kTShirt, "M"));
  EXPECT_EQ(SizeChartFromText(json, GarmentKind::kTShirt, "")->photographed_size, "S");
  const Status cut = SizeChartFromText(json.substr(0, json.find("20.5")), GarmentKind::kTShirt, "M").status();
  EXPECT_EQ(cut.reason(), "CHART_FILE");
  EXPECT_THAT(cut.message(), HasSubstr("line 3"));
}

TEST(SizeChartFile, ATableThatIsWrittenReadsBack) {
  SizeChart chart = testing::MakeSampleTrousers().chart;
  chart.sizes[2].name = "L, \"long\"";
  chart.sizes[0].measures.erase(chart.sizes[0].measures.begin());
  const Result<SizeChart> read =
      SizeChartFromText(SizeChartToCsv(chart, GarmentKind::kPants), GarmentKind::kPants, "M");
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(*read, chart);
}

TEST(SizeChartFile, AFileIsNamedInItsErrors) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "chart.csv";
  ASSERT_TRUE(WriteFileAtomically(path, kTable).ok());
  ExpectTheTable(ReadSizeChartFile(path, GarmentKind::kTShirt, "M"));
  EXPECT_THAT(ReadSizeChartFile(path, GarmentKind::kSkirt, "M").status().message(), HasSubstr("chart.csv: line 1"));
  EXPECT_EQ(ReadSizeChartFile(folder.path() / "none.csv", GarmentKind::kSkirt, "M").status().code(),
            StatusCode::kNotFound);
}

struct Fault {
  const char* text;
  const char* reason;
  const char* named;  // What the message must name.
};

TEST(SizeChartFile, EachFaultNamesItsPlace) {
  const Fault faults[] = {
      {"", "CHART_FILE", "column names"},
      {"size,chest_width\n", "CHART_FILE", "a line for each size"},
      {"name,chest_width\nS,46\n", "CHART_FILE", "line 1"},
      {"size,chest_width,chest_width\nS,46,46\n", "CHART_FILE", "twice"},
      {"size,inseam\nS,46\n", "CHART_FILE", "\"inseam\" is not a measure"},
      {"size,chest_width,body_neck\nS,46,38\n", "CHART_FILE", "body_bust"},
      {"size,chest_width\nS,46\nM,forty\n", "CHART_FILE", "line 3: column chest_width"},
      {"size,chest_width\nS,46\nM,49,50\n", "CHART_FILE", "line 3: has 3 cells"},
      {"size,chest_width\nS,46\n\n,49\n", "CHART_FILE", "line 4: names no size"},
      {"size,chest_width\nS,\"46\n", "CHART_FILE", "line 2: a quoted cell"},
      {"size,chest_width\nS,46\x01\n", "CHART_FILE", "line 2: holds a control"},
      {"size,chest_width\nS,nan\n", "CHART_FILE", "line 2"},
      {"size,chest_width\nS,1e400\n", "CHART_FILE", "line 2"},
      {"size,chest_width\nS,46\nS,49\n", "CHART_SIZE_NAME", "twice"},
      {"size,chest_width\na name that is far too long,46\n", "CHART_SIZE_NAME", "16"},
      {"size,chest_width\nM,\n", "CHART_NO_SHARED_MEASURE", "chest_width"},
      {"size,chest_width,hem_width\nS,46,\nM,,50\n", "CHART_NO_SHARED_MEASURE", "every row"},
      {"size,chest_width\nS,46\nM,-49\n", "CHART_MEASURE", "size M"},
      {"size,chest_width\nS,46\nM,490\n", "CHART_MEASURE", "490.0 cm"},
      {"size,chest_width\nS,4.6\nM,49\n", "CHART_JUMP", "decimal point"},
      {"size,chest_width\nS,49\nM,46\n", "CHART_NOT_INCREASING", "from size S to M"},
      {"size,chest_width\nS,49\nM,49\n", "CHART_NOT_INCREASING", "both rows"},
      {"size,chest_width,body_bust\nS,46,35\nM,49,90\n", "CHART_BODY_GIRTH", "35.0 cm"},
      {"size,chest_width,body_bust\nS,46,90\nM,49,90\n", "CHART_BODY_GIRTH", "does not grow"},
      {"size,chest_width,body_bust\nXS,46,90\nM,49,\nL,52,90\n", "CHART_BODY_GIRTH", "from size XS to L"},
      {"size,chest_width\nS,46\nL,52\n", "CHART_PHOTOGRAPHED_SIZE", "S, L"},
  };
  for (const Fault& fault : faults) {
    const Status status = SizeChartFromText(fault.text, GarmentKind::kTShirt, "M").status();
    EXPECT_THAT(status.reason(), ::testing::AnyOf(fault.reason, "CHART_PHOTOGRAPHED_SIZE")) << fault.text;
    const Status named =
        SizeChartFromText(fault.text, GarmentKind::kTShirt, status.reason() == fault.reason ? "M" : "S").status();
    EXPECT_EQ(named.reason(), fault.reason) << fault.text << named.ToString();
    EXPECT_THAT(named.message(), HasSubstr(fault.named)) << fault.text;
  }
  EXPECT_EQ(SizeChartFromText(kTable, GarmentKind::kTShirt, "").status().reason(), "CHART_PHOTOGRAPHED_SIZE");
  EXPECT_EQ(SizeChartFromText("size,chest_width\nM,49\n", GarmentKind::kTShirt, "")->photographed_size, "M");
}

TEST(SizeChartFile, BoundsWhatItReads) {
  std::string many = "size,chest_width\n";
  for (int i = 0; i < 41; ++i) many += "s" + std::to_string(i) + "," + std::to_string(40 + i) + "\n";
  EXPECT_THAT(SizeChartFromText(many, GarmentKind::kTShirt, "s0").status().message(), HasSubstr("more than 40 sizes"));
  const std::string wide = "size" + std::string(200000, ',') + "\nS\n";
  EXPECT_THAT(SizeChartFromText(wide, GarmentKind::kTShirt, "S").status().message(), HasSubstr("64 columns"));
  EXPECT_EQ(SizeChartFromText(std::string(300000, '\n'), GarmentKind::kTShirt, "S").status().reason(),
            "CHART_FILE_TOO_LARGE");
  EXPECT_EQ(SizeChartFromText(std::string(200000, '{'), GarmentKind::kTShirt, "S").status().reason(), "CHART_FILE");
}

// Whatever bytes come, the reader ends with a chart that is valid or with a reason.
TEST(SizeChartFile, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(20240611);
  const std::string json = R"({"photographed_size":"M","sizes":[{"name":"M","measures_cm":{"chest_width":49}}]})";
  int read_count = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = round % 2 == 0 ? std::string(kTable) : json;
    for (unsigned count = 1 + random() % 4; count > 0; --count) {
      const size_t place = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[place] = static_cast<char>(random());
          break;
        case 1:
          text.insert(place, 1, ",;\t\"\n\r{}[]:.0-"[random() % 15]);
          break;
        default:
          text.erase(place, 1 + random() % 5);
          if (text.empty()) text = "s";
      }
    }
    const Result<SizeChart> chart = SizeChartFromText(text, GarmentKind::kTShirt, "M");
    if (chart.ok()) {
      ++read_count;
      ASSERT_TRUE(ValidateSizeChart(GarmentKind::kTShirt, *chart).ok()) << text;
    } else {
      ASSERT_FALSE(chart.status().reason().empty()) << text;
    }
  }
  EXPECT_GT(read_count, 100);  // Some damage does not matter: the reader was really reached.
}

TEST(SizeChartFile, HelpNamesTheColumns) {
  const std::string help = SizeChartFileHelp();
  for (const char* name : {"size", "chest_width", "back_rise", "body_hip"}) EXPECT_THAT(help, HasSubstr(name));
}

}  // namespace
}  // namespace fitroom
