! Matrix Market files; one that is not there is an array without rows.
module matrix_market
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  type coordinates
    integer, allocatable :: row(:), column(:)
    real(real64), allocatable :: value(:)
  end type

contains

  ! Opens FOLDER/NAME.mtx behind its comments.
  logical function opened(folder, name)
    character(*), intent(in) :: folder, name
    character(len_trim(folder) + len(name) + 5) :: file
    character :: first
    file = trim(folder)//'/'//name//'.mtx'
    inquire (file=file, exist=opened)
    if (.not. opened) return
    open (10, file=file, action='read')
    first = '%'
    do while (first == '%')
      read (10, '(a)') first
    end do
    backspace (10)
  end function

  function read_vector(folder, name) result(values)
    character(*), intent(in) :: folder, name
    real(real64), allocatable :: values(:)
    integer :: rows
    rows = 0
    if (opened(folder, name)) read (10, *) rows
    allocate (values(rows))
    if (rows > 0) read (10, *) values
    close (10)
  end function

  function read_sparse(folder, name) result(matrix)
    character(*), intent(in) :: folder, name
    type(coordinates) :: matrix
    integer :: rows, columns, entries, k
    entries = 0
    if (opened(folder, name)) read (10, *) rows, columns, entries
    allocate (matrix%row(entries), matrix%column(entries), matrix%value(entries))
    if (entries > 0) read (10, *) (matrix%row(k), matrix%column(k), matrix%value(k), k=1, entries)
    close (10)
  end function

  subroutine write_vector(file, values)
    character(*), intent(in) :: file
    real(real64), intent(in) :: values(:)
    open (10, file=file, action='write')
    write (10, '(a)') '%%MatrixMarket matrix array real general'
    write (10, '(i0, " 1")') size(values)
    write (10, '(es24.16e3)') values
    close (10)
  end subroutine
end module
