! An exported Airy system by MUMPS, its contact law by projected Gauss-Seidel:
!
!   airy_mumps INPUT OUTPUT TOLERANCE  |  airy_mumps --version
!
!   [S C_F' C_C'; C_F 0 0; C_C 0 0] [x; l; l'] = [q; F; F_C - F0],  l' = -u_C
!
! With the Schur complement A of l' and the condensed right-hand side c: A l' = F_C + c, so
! u_C = D (F_C + c), D = (-A)^-1.
program airy_mumps
  use contact_sweeps
  use matrix_market
  use, intrinsic :: iso_fortran_env, only: int64, real64
  implicit none
  include 'dmumps_struc.h'
  type(dmumps_struc) :: mumps
  type(coordinates) :: S, C_F, C_C
  character(1000) :: input, output, word
  real(real64), allocatable :: q(:), F(:), F0(:), gap(:), mu(:), D(:, :), b(:), F_C(:)
  real(real64) :: tolerance, error = 0
  integer :: n, n_c, i, info, sweeps = 0
  integer(int64) :: ticks(5), rate

  call get_command_argument(1, input)
  call get_command_argument(2, output)
  mumps%comm = 0; mumps%sym = 2; mumps%par = 1
  call run(-1)
  if (input == '--version') then
    print '(2a)', 'MUMPS ', trim(mumps%version_number)
    stop
  end if
  call get_command_argument(3, word)
  read (word, *) tolerance

  S = read_sparse(input, 'S'); C_F = read_sparse(input, 'C_F'); C_C = read_sparse(input, 'C_C')
  q = read_vector(input, 'q'); F = read_vector(input, 'F'); F0 = read_vector(input, 'F0')
  gap = read_vector(input, 'gap'); mu = read_vector(input, 'mu')
  n = size(q); n_c = size(F0)
  mumps%n = n + size(F) + n_c; mumps%lrhs = mumps%n; mumps%nrhs = 1
  allocate (mumps%irn, source=[S%row, n + C_F%row, n + size(F) + C_C%row])
  allocate (mumps%jcn, source=[S%column, C_F%column, C_C%column])
  allocate (mumps%a, source=[S%value, C_F%value, C_C%value])
  allocate (mumps%rhs, source=[q, F, -F0])
  mumps%nnz = size(mumps%a)
  allocate (mumps%listvar_schur, source=[(n + size(F) + i, i=1, n_c)])
  mumps%size_schur = n_c; mumps%lredrhs = n_c
  allocate (mumps%schur(n_c**2), mumps%redrhs(n_c))
  mumps%icntl(1:4) = [-1, -1, -1, 0] ! quiet
  mumps%icntl(19) = min(n_c, 1) ! Schur complement, its lower triangle by rows: LAPACK's upper one

  call system_clock(ticks(1), rate)
  call run(1)
  call system_clock(ticks(2))
  call run(2)
  mumps%icntl(26) = min(n_c, 1) ! condense
  call run(3)
  D = -reshape(mumps%schur, [n_c, n_c])
  call dpotrf('U', n_c, D, max(n_c, 1), info)
  if (info == 0) call dpotri('U', n_c, D, max(n_c, 1), info)
  if (info /= 0) call answer('breakdown', 'the Schur complement is not negative definite')
  do i = 1, n_c
    D(i, :i - 1) = D(:i - 1, i)
  end do
  b = matmul(D, mumps%redrhs) - gap
  call system_clock(ticks(3))
  allocate (F_C(n_c))
  call sweep_until_converged(D, b, mu, tolerance, F_C, sweeps, error)
  call system_clock(ticks(4))
  mumps%redrhs = -(matmul(D, F_C) + b + gap)
  mumps%icntl(26) = 2*min(n_c, 1) ! expand
  if (n_c > 0) call run(3)
  call system_clock(ticks(5))
  if (force_error() > 1e-6) call answer('breakdown', 'MUMPS: its answer misses the known forces')
  call write_vector(trim(output)//'/x.mtx', mumps%rhs(:n))
  call write_vector(trim(output)//'/F_C.mtx', F_C)
  call answer(merge('ok           ', 'not_converged', error <= tolerance), '')

contains

  ! |C_F x - F| / (|F| + |F_C|): MUMPS reports no error for a singular system.
  real(real64) function force_error()
    real(real64) :: off(size(F))
    integer :: k
    off = -F
    do k = 1, size(C_F%value)
      off(C_F%row(k)) = off(C_F%row(k)) + C_F%value(k)*mumps%rhs(C_F%column(k))
    end do
    force_error = norm2(off)/max(norm2(F) + norm2(F_C), tiny(tolerance))
  end function

  subroutine run(job)
    integer, intent(in) :: job
    character(40) :: message
    mumps%job = job
    call dmumps(mumps)
    write (message, '("MUMPS: INFOG", 2(1x, i0))') mumps%infog(1:2)
    if (mumps%infog(1) < 0) call answer('breakdown', message)
  end subroutine

  subroutine answer(status, message)
    character(*), intent(in) :: status, message
    real(real64) :: time_s(4)
    time_s = real(ticks(2:5) - ticks(1:4), real64)/rate
    open (10, file=trim(output)//'/answer.json', action='write')
    write (10, '(5a)') '{"status": "', trim(status), '", "message": "', trim(message), '",'
    if (status /= 'breakdown') then
      write (10, '(a, 4(a, es11.4), a)') '"stages": {', '"order": ', time_s(1), ', "condense": ', &
        time_s(2), ', "contact": ', time_s(3), ', "recover": ', time_s(4), '},'
      write (10, '(a, es11.4, a, i0, a, es11.4, a)') '"time_s": ', sum(time_s), &
        ', "contact_iterations": ', sweeps, ', "error_estimate": ', error, ','
    end if
    if (status == 'breakdown') write (10, '(a)') '"time_s": 0,'
    write (10, '(a)') '"parameters": "Schur complement; projected Gauss-Seidel"}'
    close (10)
    stop
  end subroutine
end program
