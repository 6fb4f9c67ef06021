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

  !> A slender block that rocks without slip.
  type, bind(c) :: stickslip_slender_block
    real(c_double) :: p = 0           ! frequency parameter [rad/s]
    real(c_double) :: alpha = 0       ! from its side to the line from a corner to the center of mass [rad]
    real(c_double) :: alpha_left = 0  ! of its left corner, if it differs; 0: alpha
    real(c_double) :: restitution = 0 ! rate after an impact over that before, 0 to 1
  end type

  !> A rigid block that rocks, slides and leaves the ground.
  type, bind(c) :: stickslip_rocking_block
    real(c_double) :: width = 0, height = 0 ! [m]
    real(c_double) :: mu = 0                ! coefficient of friction; 0: it never slips
    real(c_double) :: restitution = 0       ! of its base; 0: that of the impact law
    real(c_double) :: center_offset = 0     ! of the center of mass to the right of the middle [m]
    real(c_double) :: center_height = 0     ! of the center of mass [m]; 0: half the height
    real(c_double) :: gyration_radius = 0   ! about the center of mass [m]; 0: uniform
  end type

  !> The complete state of either block. By default at rest.
  type, bind(c) :: stickslip_rocking_state
    real(c_double) :: rotation = 0, rate = 0         ! positive to the right [rad], [rad/s]
    real(c_double) :: mode = 0                       ! -1, 1: on a corner; 0: at rest; 2: sliding; 3: in flight
    real(c_double) :: overturned = 0                 ! -1, 1: on its side; 0: it is not
    real(c_double) :: slip = 0                       ! direction in which it slips
    real(c_double) :: displacement = 0, velocity = 0 ! of the base or the corner [m], [m/s]
    real(c_double) :: rise = 0, climb = 0            ! of the center of mass in flight [m], [m/s]
  end type

  integer, parameter :: STICKSLIP_MOST_SUPPORTS = 16
  enum, bind(c)
    enumerator :: STICKSLIP_SWIVEL_CASTER = 0, STICKSLIP_FIXED_WHEEL = 1, STICKSLIP_FOOT = 2
  end enum

  !> What a cart stands on.
  type, bind(c) :: stickslip_support
    integer(c_int) :: kind = 0       ! STICKSLIP_SWIVEL_CASTER, ...
    real(c_double) :: at(2) = 0      ! in the frame of the cart [m]
    real(c_double) :: heading = 0    ! of a caster from its wheel to its pivot, of a wheel its direction [rad]
    real(c_double) :: mu = 0         ! friction across the wheel over its load; of a foot in any direction
    real(c_double) :: reach = 0      ! of a caster [m]
    real(c_double) :: rolling_mu = 0 ! rolling resistance over the load
    real(c_double) :: share = 0      ! of the weight; all 0: those of equal stiffness
  end type

  !> A rigid cart in the plane.
  type, bind(c) :: stickslip_cart
    integer(c_int) :: supports = 0 ! how many entries below count, 1 to 16
    type(stickslip_support) :: support(STICKSLIP_MOST_SUPPORTS)
    real(c_double) :: radius_of_gyration = 0 ! [m]
    real(c_double) :: center(2) = 0          ! of mass [m]; with shares it follows from them
  end type

  !> The complete state of a cart. By default at rest, with the headings of its casters.
  type, bind(c) :: stickslip_cart_state
    real(c_double) :: displacement(2) = 0, yaw = 0  ! [m], [rad]
    real(c_double) :: velocity(2) = 0, yaw_rate = 0 ! [m/s], [rad/s]
    real(c_double) :: started = 0                   ! 1 after the first step: what follows then counts
    real(c_double) :: headings(STICKSLIP_MOST_SUPPORTS) = 0
    real(c_double) :: moving = 0, known = 0         ! 1 if it moves; how many contacts count
    real(c_double) :: contacts(2*STICKSLIP_MOST_SUPPORTS) = 0
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

    !> Advance a slender block through one segment.
    integer(c_int) function stickslip_advance_slender_block(block, segment, state) bind(c)
      import
      type(stickslip_slender_block), intent(in) :: block
      type(stickslip_segment), intent(in) :: segment
      type(stickslip_rocking_state), intent(inout) :: state
    end function

    !> Advance a rigid block through one segment.
    integer(c_int) function stickslip_advance_rocking_block(block, segment, state) bind(c)
      import
      type(stickslip_rocking_block), intent(in) :: block
      type(stickslip_segment), intent(in) :: segment
      type(stickslip_rocking_state), intent(inout) :: state
    end function

    !> Advance a cart through one segment.
    integer(c_int) function stickslip_advance_cart(cart, segment, state) bind(c)
      import
      type(stickslip_cart), intent(in) :: cart
      type(stickslip_planar_segment), intent(in) :: segment
      type(stickslip_cart_state), intent(inout) :: state
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
