#pragma once
// Files that are part of the program: made into arrays by embed.cmake.
#include <string_view>

namespace packbed::report {

std::string_view page();        // page.html
std::string_view style();       // bundle.css
std::string_view script();      // bundle.js
std::string_view references();  // cases/reference/ct_beds.csv

}  // namespace packbed::report
