!=== attribute_exclude_nostepin_noview
! rule: the attribute list NOSTEPIN, NOVIEW is wrong
! source: [K §9.1]
MODULE Demo(NOSTEPIN, NOVIEW)  ! -> RG215
ENDMODULE
!=== attribute_exclude_noview_nostepin
! rule: the attribute list NOVIEW, NOSTEPIN is wrong
! source: [K §9.1]
MODULE Demo(NOVIEW, NOSTEPIN)  ! -> RG215
ENDMODULE
!=== attribute_exclude_noview_readonly
! rule: the attribute list NOVIEW, READONLY is wrong
! source: [K §9.1]
MODULE Demo(NOVIEW, READONLY)  ! -> RG215
ENDMODULE
!=== attribute_exclude_noview_viewonly
! rule: the attribute list NOVIEW, VIEWONLY is wrong
! source: [K §9.1]
MODULE Demo(NOVIEW, VIEWONLY)  ! -> RG215
ENDMODULE
!=== attribute_exclude_viewonly_readonly
! rule: the attribute list VIEWONLY, READONLY is wrong
! source: [K §9.1]
MODULE Demo(VIEWONLY, READONLY)  ! -> RG215
ENDMODULE
!=== attribute_nostepin
! rule: the attribute list NOSTEPIN
! source: [K §9.1]
MODULE Demo(NOSTEPIN)
ENDMODULE
!=== attribute_nostepin_readonly
! rule: the attribute list NOSTEPIN, READONLY
! source: [K §9.1]
MODULE Demo(NOSTEPIN, READONLY)
ENDMODULE
!=== attribute_noview
! rule: the attribute list NOVIEW
! source: [K §9.1]
MODULE Demo(NOVIEW)
ENDMODULE
!=== attribute_order_readonly_sysmodule
! rule: the attribute list READONLY, SYSMODULE is wrong
! source: [K §9.1]
MODULE Demo(READONLY, SYSMODULE)  ! -> RG215
ENDMODULE
!=== attribute_readonly
! rule: the attribute list READONLY
! source: [K §9.1]
MODULE Demo(READONLY)
ENDMODULE
!=== attribute_sysmodule
! rule: the attribute list SYSMODULE
! source: [K §9.1]
MODULE Demo(SYSMODULE)
ENDMODULE
!=== attribute_sysmodule_nostepin_viewonly
! rule: the attribute list SYSMODULE, NOSTEPIN, VIEWONLY
! source: [K §9.1]
MODULE Demo(SYSMODULE, NOSTEPIN, VIEWONLY)
ENDMODULE
!=== attribute_sysmodule_noview
! rule: the attribute list SYSMODULE, NOVIEW
! source: [K §9.1]
MODULE Demo(SYSMODULE, NOVIEW)
ENDMODULE
!=== attribute_twice_sysmodule_sysmodule
! rule: the attribute list SYSMODULE, SYSMODULE is wrong
! source: [K §9.1]
MODULE Demo(SYSMODULE, SYSMODULE)  ! -> RG215
ENDMODULE
!=== attribute_viewonly
! rule: the attribute list VIEWONLY
! source: [K §9.1]
MODULE Demo(VIEWONLY)
ENDMODULE
!=== datum_behind_routine
! rule: no datum behind a routine
! source: [K §5, 9.1]
MODULE Demo
    PROC main()
    ENDPROC
    VAR num a;  ! -> RG213
ENDMODULE
!=== entry_missing
! rule: a task has a routine to start in
! source: [K §9]
! given: system
! at 1: RG331?
MODULE Demo
    PROC start()
    ENDPROC
ENDMODULE
!=== entry_with_parameters
! rule: a task starts in a routine without parameters
! source: [K §9]
! given: system
MODULE Demo
    PROC main(num speed)  ! -> RG331
        VelSet speed, speed;
    ENDPROC
ENDMODULE
!=== order
! rule: types, then data, then routines
! source: [K §5, 9.1]
MODULE Demo
    RECORD r
        num x;
    ENDRECORD
    ALIAS num n;
    CONST num c := 1;
    VAR r a;
    PERS n p := 1;
    PROC main()
    ENDPROC
ENDMODULE
!=== type_behind_datum
! rule: no type behind a datum
! source: [K §5, 9.1]
MODULE Demo
    VAR num a;
    ALIAS num n;  ! -> RG213
ENDMODULE
!=== unknown_attribute
! rule: there are five attributes
! source: [K §9.1]
MODULE Demo(SYSTEM)  ! -> RG201
ENDMODULE
