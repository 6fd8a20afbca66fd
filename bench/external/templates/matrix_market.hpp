#include <Eigen/Dense>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Matrix Market, "array": rows and columns, then numbers column by column; of a symmetric matrix
// those of its lower triangle.
MatrixXd read(const std::string& file) {
  std::ifstream in(file);
  std::string line, header;
  std::getline(in, header);
  while (std::getline(in, line) && line[0] == '%') continue;
  const bool is_symmetric = header.find(" symmetric") != header.npos;
  Eigen::Index rows = 0, columns = 0;
  std::istringstream(line) >> rows >> columns;
  MatrixXd matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = is_symmetric ? j : 0; i < rows; ++i) {
      in >> matrix(i, j);
      if (is_symmetric) matrix(j, i) = matrix(i, j);
    }
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return matrix;
}

void write(const std::string& file, const MatrixXd& matrix) {
  std::ofstream out(file);
  out.precision(17);
  out << "%%MatrixMarket matrix array real general\n" << matrix.rows() << ' ' << matrix.cols();
  for (const double entry : matrix.reshaped()) out << '\n' << entry;
  out << '\n';
}

// time_s: of the solve, without reading and writing.
void write_answer(const std::string& folder, const std::string& status, const std::string& message,
                  int steps, double time_s) {
  std::ofstream(folder + "/answer.json")
      << "{\"status\": \"" << status << "\", \"message\": \"" << message
      << "\", \"contact_iterations\": " << steps << ", \"time_s\": " << time_s << "}\n";
}
