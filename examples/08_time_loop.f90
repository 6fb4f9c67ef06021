! Example 8 in Fortran: a block stands on the floor of a building, which a seismic code steps itself.

! stickslip/stickslip.h, which says what each number means.
module stickslip
  use, intrinsic :: iso_c_binding
  implicit none

  type, bind(c) :: slider_type
    real(c_double) :: slip_level = 0, static_level = 0, natural_frequency = 0, damping = 0, slope_degrees = 0
    real(c_double) :: gap = 0, backward_gap = 0, restitution = 0
    integer(c_int) :: one_way = 0, clipped = 0
  end type

  type, bind(c) :: segment_type
    real(c_double) :: duration = 0, start = 0, end = 0, vertical_start = 0, vertical_end = 0
  end type

  type, bind(c) :: state_type
    real(c_double) :: displacement = 0, velocity = 0, mode = 0, in_flight = 0, gap = 0, gap_velocity = 0
  end type

  interface
    integer(c_int) function advance(slider, segment, state) bind(c, name="stickslip_advance")
      import
      type(slider_type), intent(in) :: slider
      type(segment_type), intent(in) :: segment
      type(state_type), intent(inout) :: state
    end function

    type(c_ptr) function message_pointer() bind(c, name="stickslip_message")
      import
    end function

    integer(c_size_t) function strlen(text) bind(c)
      import
      type(c_ptr), value :: text
    end function
  end interface

contains

  ! What was wrong in the last call that failed.
  function message() result(text)
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    call c_f_pointer(message_pointer(), letters, [strlen(message_pointer())])
    allocate (character(len=size(letters)) :: text)
    do i = 1, size(letters)
      text(i:i) = letters(i)
    end do
  end function

end module

program time_loop
  use stickslip
  implicit none
  real(c_double), parameter :: pi = acos(-1d0), dt = 0.005d0, wn = 2*pi/0.5d0
  type(slider_type) :: slider
  type(state_type) :: block                                   ! at rest
  real(c_double) :: displacement = 0, velocity = 0, floor = 0 ! of the floor, relative to the ground; its acceleration
  real(c_double) :: t, ground, pull
  integer :: i

  slider%slip_level = 0.3d0*9.80665d0
  do i = 1, 2000
    t = i*dt
    ground = 2*exp(-t/4)*sin(2*pi*t/0.5d0)                    ! [m/s^2]
    ! One storey, damping 5 %, period 0.5 s, stepped by the semi-implicit Euler method.
    pull = wn**2*displacement + 2*0.05d0*wn*velocity
    velocity = velocity - (ground + pull)*dt
    displacement = displacement + velocity*dt
    if (advance(slider, segment_type(dt, floor, -pull), block) /= 0) then
      print '(a)', message()
      error stop
    end if
    floor = -pull
  end do
  print '(a, f6.4, a)', 'after the earthquake the block is ', block%displacement, &
    ' m from where it stood, '//trim(merge('at rest      ', 'still sliding', abs(block%mode) < 0.5d0))
end program
