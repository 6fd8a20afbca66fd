// The fields of a record that follow from others: medians and intervals of samples, totals, words.
#pragma once

#include "bench/records/record.hpp"

namespace airybench {

// Of samples_s, stage_samples, assembly_samples_s, noise_kernel_samples_s, grid; status and
// claimed_status; error_discretisation and error_stress.
void summarise(Record& record);

// `wrong_success` where the method said ok and the verifier disagrees, `unverified` where it has no
// reference; else the status. A mesh on which nothing is known is not the method's fault.
std::string outcome_of(const Record& record);

}  // namespace airybench
