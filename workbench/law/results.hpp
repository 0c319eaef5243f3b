#pragma once
// What is told of the trials: curves, pictures, the result for summary.json, and the table on the terminal.

#include "workbench/law/trials.hpp"
#include "workbench/office.hpp"

namespace beadwork::law {

/// A curve and a picture of each mode.
void put_curves(const std::vector<Trial>& trials, Office& office);

Office::Json result_of(const std::vector<Family>& families, const std::vector<Trial>& trials);

/// A table for each family, with what is to be said of it.
std::string table_of(const std::vector<Family>& families, const std::vector<Trial>& trials);

/// Done, or that of the first that could not be run.
ExitCode worst_of(const std::vector<Trial>& trials);

}  // namespace beadwork::law
