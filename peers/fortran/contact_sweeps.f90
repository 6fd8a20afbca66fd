! Projected Gauss-Seidel on a contact law r = D F + b of normal and tangential
! components in turn, or of normal ones only.
module contact_sweeps
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none

contains

  ! The error is a sweep's change over 1 - rate of convergence, relative to F.
  subroutine sweep_until_converged(D, b, mu, tolerance, F, sweeps, error)
    real(real64), intent(in) :: D(:, :), b(:), mu(:), tolerance
    real(real64), intent(out) :: F(:), error
    integer, intent(out) :: sweeps
    real(real64) :: trial, change, before
    integer :: components, i
    F = 0; error = 0; before = 0
    components = size(b)/max(size(mu), 1)
    do sweeps = 1, 1000000
      change = 0
      do i = 1, size(b)
        trial = F(i) - (dot_product(D(:, i), F) + b(i))/D(i, i)
        if (components == 1 .or. mod(i, 2) == 1) then
          trial = min(trial, 0.0_real64)
        else
          trial = sign(min(abs(trial), -mu(i/2)*F(i - 1)), trial)
        end if
        change = hypot(change, trial - F(i))
        F(i) = trial
      end do
      error = change/max(norm2(F), tiny(change))
      if (change < before) error = error/(1 - change/before)
      if (change == 0 .or. (change < before .and. error <= tolerance)) return
      before = change
    end do
  end subroutine
end module
