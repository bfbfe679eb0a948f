#pragma once

#include <ostream>
#include <span>
#include <string>

#include "common/garment_record/garment_record.h"

namespace fitroom::shop_catalog {

// The option that names the server, the same in all commands that speak to it.
inline constexpr char kServerOption[] = "--server";
inline constexpr char kServerVariable[] = "FITROOM_SHOP_SERVER";
inline constexpr char kDefaultServer[] = "127.0.0.1:50052";

// Prints one line a garment under a head line.
void PrintGarmentTable(std::span<const GarmentRecord> records, std::ostream& out);

// Prints one garment for people: scale and points of each view, images, measures.
void PrintGarment(const GarmentRecord& record, std::ostream& out);

// Returns a JSON object of a garment, or an array of them, without outlines.
std::string GarmentRecordToJson(const GarmentRecord& record);
std::string GarmentRecordsToJson(std::span<const GarmentRecord> records);

}  // namespace fitroom::shop_catalog
