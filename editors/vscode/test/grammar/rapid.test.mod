! SYNTAX TEST "source.rapid" "RAPID"

MODULE cell(SYSMODULE, NOSTEPIN)
! <~----- keyword.declaration.module.rapid
!      ^^^^ entity.name.namespace.rapid
!           ^^^^^^^^^ storage.modifier.rapid
  LOCAL PERS tooldata grip := [TRUE,[[0,0,1.5E1],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
! ^^^^^ storage.modifier.rapid
!       ^^^^ storage.type.rapid
!            ^^^^^^^^ support.type.rapid
!                     ^^^^ variable.other.rapid
!                          ^^ keyword.operator.assignment.rapid
!                              ^^^^ constant.language.boolean.rapid
!                                         ^^^^^ constant.numeric.rapid
  PROC main()
! ^^^^ keyword.declaration.function.rapid
!      ^^^^ entity.name.function.rapid
    if n<>4 then
!   ^^ keyword.control.rapid
!       ^^ keyword.operator.comparison.rapid
!           ^^^^ keyword.control.rapid
      TPWrite "a ""quoted"" \0A ! text" \Num:=n; ! comment
!     ^^^^^^^ entity.name.function.call.rapid
!             ^^^^^^^^^^^^^^^^^^^^^^^^^ string.quoted.double.rapid
!                ^^ constant.character.escape.rapid
!                           ^^^ constant.character.escape.rapid
!                                       ^ keyword.operator.optional.rapid
!                                        ^^^ variable.parameter.rapid
!                                                ^^^^^^^^^ comment.line.exclamation.rapid
    ENDIF
    MoveL Offs(p10, 0, 0, 10), v100, z10, grip \WObj:=wobj0;
!   ^^^^^ entity.name.function.call.rapid
!         ^^^^ entity.name.function.call.rapid
!                              ^^^^ support.constant.rapid
!                                    ^^^ support.constant.rapid
    %"proc" + NumToStr(n, 0)%;
!   ^ keyword.operator.late.rapid
    n := 7 DIV 2 MOD 3;
!          ^^^ keyword.operator.word.rapid
!                ^^^ keyword.operator.word.rapid
  ERROR
! ^^^^^ keyword.control.rapid
    IF ERRNO = ERR_SOCK_TIMEOUT RETRY;
!      ^^^^^ support.constant.rapid
!              ^^^^^^^^^^^^^^^^ support.constant.error.rapid
!                               ^^^^^ keyword.control.rapid
  ENDPROC
! ^^^^^^^ keyword.declaration.end.rapid
  LOCAL FUNC num twice(num v)
! ^^^^^ storage.modifier.rapid
!       ^^^^ keyword.declaration.function.rapid
!            ^^^ support.type.rapid
!                ^^^^^ entity.name.function.rapid
    RETURN 2 * v;
  ENDFUNC
ENDMODULE
