// One method under several names: records keep the name that was asked for.
#pragma once

#include <string>

namespace airybench {

// The general name behind the paper's: SDTIC3 → SYMMLQ:DTIC3, SSKY → SYMMLQ:SKY,
// 3STEPCG6 → 3STEPCG:DTIC6; SSOR's parameter without needless zeros.
std::string general_name(const std::string& method);

// "SYMMLQ" of "SYMMLQ:DTIC3".
std::string family_of(const std::string& general_name);

// Of a family that has no stop to choose: its records are the same under both.
bool is_direct(const std::string& general_name);

}  // namespace airybench
