// Names that say how a method is made: "3STEPCG:DTIC3", "SYMMLQ:SSOR0.7,refine=yes",
// "ALM:r=20,rho=32". A family, a preconditioner, options.
#pragma once

#include <initializer_list>
#include <map>
#include <string>

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

// What a family's function takes its choices out of. All throw std::invalid_argument: one line that
// names what is wrong and what is valid.
class GeneralName {
 public:
  explicit GeneralName(const std::string& name);
  const std::string& name() const { return name_; }
  const std::string& family() const { return family_; }
  const std::string& first() const { return first_; }  // what follows the colon, if it has no '='
  [[noreturn]] void refuse(const std::string& why) const;

  MakePreconditioner preconditioner() const;  // `first`
  // Options: each is taken out.
  std::string one_of(const std::string& key, const std::string& otherwise,
                     std::initializer_list<const char*> allowed);
  double positive(const std::string& key);
  int whole(const std::string& key, int otherwise, int least, int most);
  Refine refine() {
    return one_of("refine", "no", {"yes", "no"}) == "yes" ? Refine::yes : Refine::no;
  }
  void refuse_rest(const std::string& valid) const;  // the options that nothing has taken

 private:
  std::string take(const std::string& key, const std::string& otherwise);

  std::string name_, family_, first_;
  std::map<std::string, std::string> options_;
};

// What the methods of a Krylov family with `name.first()` have in common.
Method krylov_method(const GeneralName& name, const std::string& summary);

}  // namespace airybench
