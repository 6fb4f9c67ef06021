! Fortran module of the C interface, stickslip/stickslip.h, which explains every number. SI units.
!
! Compile this file with your own, for example `gfortran stickslip.f90 my_code.f90`, and link to stickslip::c; the CMake
! target stickslip::fortran does both. Components that you leave out are 0. A time loop, with a model made once:
!
!     type(stickslip_slider) :: slider
!     type(stickslip_state) :: state
!     type(c_ptr) :: model
!     slider%slip_level = 0.3d0*9.80665d0
!     if (stickslip_create(slider, model) /= STICKSLIP_OK) error stop stickslip_message()
!     ... if (stickslip_step(model, stickslip_segment(dt, before, now), state) /= STICKSLIP_OK) ...
!     call stickslip_destroy(model)
module stickslip
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_int, c_ptr, c_size_t
  implicit none
  private :: c_char, c_f_pointer, c_size_t

  enum, bind(c)
    enumerator :: STICKSLIP_OK = 0, STICKSLIP_INVALID_ARGUMENT = 1, STICKSLIP_OVERFLOW = 2
    enumerator :: STICKSLIP_NO_CONVERGENCE = 3, STICKSLIP_ERROR = 4
  end enum

  !> A mass on friction, with an optional spring, damper and stops, on level or sloping ground.
  type, bind(c) :: stickslip_slider
    real(c_double) :: slip_level = 0        ! friction during sliding [m/s^2]
    real(c_double) :: static_level = 0      ! maximum friction at rest [m/s^2]; 0: slip_level
    real(c_double) :: natural_frequency = 0 ! of the spring and the mass without friction [rad/s]
    real(c_double) :: damping = 0           ! of the damper per unit mass [1/s]
    real(c_double) :: slope_degrees = 0     ! slope of the ground [degrees]
    real(c_double) :: gap = 0               ! stop at x = gap [m]; 0: none
    real(c_double) :: backward_gap = 0      ! stop at x = -backward_gap [m]; 0: none
    real(c_double) :: restitution = 0       ! of an impact on a stop, 0 to 1
    integer(c_int) :: one_way = 0           ! 1: the slider never slides backward
    integer(c_int) :: clipped = 0           ! 1: it never leaves the ground
  end type

  !> Ground acceleration, linear in time from `start` to `end` over `duration`.
  type, bind(c) :: stickslip_segment
    real(c_double) :: duration = 0                         ! [s]
    real(c_double) :: start = 0, end = 0                   ! horizontal [m/s^2]
    real(c_double) :: vertical_start = 0, vertical_end = 0 ! upward [m/s^2]
  end type

  !> The complete state. By default at rest at x = 0.
  type, bind(c) :: stickslip_state
    real(c_double) :: displacement = 0 ! relative to the ground [m]
    real(c_double) :: velocity = 0     ! relative to the ground [m/s]
    real(c_double) :: mode = 0         ! 0: stuck; 1 or -1: sliding
    real(c_double) :: in_flight = 0    ! 1 while the slider has left the ground
    real(c_double) :: gap = 0          ! between slider and ground, in flight [m]
    real(c_double) :: gap_velocity = 0 ! its rate of change [m/s]
  end type

  !> Ground acceleration with two horizontal components: along the axis, and transverse to it.
  type, bind(c) :: stickslip_planar_segment
    real(c_double) :: duration = 0                         ! [s]
    real(c_double) :: start(2) = 0, end(2) = 0             ! horizontal [m/s^2]
    real(c_double) :: vertical_start = 0, vertical_end = 0 ! upward [m/s^2]
  end type

  !> The complete state of a slider in the plane. By default at rest at r = 0.
  type, bind(c) :: stickslip_planar_state
    real(c_double) :: displacement(2) = 0 ! relative to the ground [m]
    real(c_double) :: velocity(2) = 0     ! relative to the ground [m/s]
    real(c_double) :: mode = 0            ! 0: stuck; 1: sliding; 2: sliding along the stop
    real(c_double) :: in_flight = 0       ! 1 while the slider has left the ground
    real(c_double) :: gap = 0             ! between slider and ground, in flight [m]
    real(c_double) :: gap_velocity = 0    ! its rate of change [m/s]
  end type

  !> A friction pendulum with several surfaces.
  type, bind(c) :: stickslip_pendulum
    integer(c_int) :: surfaces = 0      ! how many entries below count, 1 to 8; nested 3, 5 or 7
    integer(c_int) :: nested = 0        ! 1: inner, lower, upper, (lower, upper); 0: elements in series
    real(c_double) :: radii(8) = 0      ! effective radii [m]
    real(c_double) :: mu(8) = 0         ! coefficients of friction
    real(c_double) :: capacities(8) = 0 ! travel to the stop [m]; 0: none
    real(c_double) :: restitution = 0   ! of the impact where all are at their stops, 0 to 1
    real(c_double) :: damping = 0       ! of a damper in parallel, per unit mass [1/s]
    integer(c_int) :: clipped = 0       ! 1: it never leaves the ground
  end type

  !> Its complete state. By default at rest at its center.
  type, bind(c) :: stickslip_pendulum_state
    type(stickslip_state) :: motion
    real(c_double) :: memory(13) = 0 ! of its elements
  end type

  interface
    !> Check a slider and make a model of it. Returns STICKSLIP_OK or an error; then the model is c_null_ptr.
    integer(c_int) function stickslip_create(slider, model) bind(c)
      import
      type(stickslip_slider), intent(in) :: slider
      type(c_ptr), intent(out) :: model
    end function

    !> Advance a model through one segment. Returns STICKSLIP_OK or an error; then the state is unchanged.
    integer(c_int) function stickslip_step(model, segment, state) bind(c)
      import
      type(c_ptr), value :: model
      type(stickslip_segment), intent(in) :: segment
      type(stickslip_state), intent(inout) :: state
    end function

    !> Release a model.
    subroutine stickslip_destroy(model) bind(c)
      import
      type(c_ptr), value :: model
    end subroutine

    !> Advance a slider through one segment without a model: the slider is checked at each call.
    integer(c_int) function stickslip_advance(slider, segment, state) bind(c)
      import
      type(stickslip_slider), intent(in) :: slider
      type(stickslip_segment), intent(in) :: segment
      type(stickslip_state), intent(inout) :: state
    end function

    !> Advance a model through one segment in the plane.
    integer(c_int) function stickslip_step_planar(model, segment, state) bind(c)
      import
      type(c_ptr), value :: model
      type(stickslip_planar_segment), intent(in) :: segment
      type(stickslip_planar_state), intent(inout) :: state
    end function

    !> The same without a model: the slider is checked at each call.
    integer(c_int) function stickslip_advance_planar(slider, segment, state) bind(c)
      import
      type(stickslip_slider), intent(in) :: slider
      type(stickslip_planar_segment), intent(in) :: segment
      type(stickslip_planar_state), intent(inout) :: state
    end function

    !> Check a slider without making a model.
    integer(c_int) function stickslip_check(slider) bind(c)
      import
      type(stickslip_slider), intent(in) :: slider
    end function

    !> Advance a pendulum with several surfaces through one segment. `displacements` receives those of its elements [m].
    integer(c_int) function stickslip_advance_pendulum(pendulum, segment, state, displacements) bind(c)
      import
      type(stickslip_pendulum), intent(in) :: pendulum
      type(stickslip_segment), intent(in) :: segment
      type(stickslip_pendulum_state), intent(inout) :: state
      real(c_double), intent(inout), optional :: displacements(8)
    end function
  end interface

contains

  !> Message of the last failed call of this thread.
  function stickslip_message() result(text)
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    interface
      type(c_ptr) function message_pointer() bind(c, name="stickslip_message")
        import
      end function
      integer(c_size_t) function strlen(text) bind(c)
        import
        type(c_ptr), value :: text
      end function
    end interface
    call c_f_pointer(message_pointer(), letters, [strlen(message_pointer())])
    allocate (character(len=size(letters)) :: text)
    do i = 1, size(letters)
      text(i:i) = letters(i)
    end do
  end function

end module
